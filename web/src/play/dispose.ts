// Gives back what a part of the scene holds on the graphics card.
import { InstancedMesh, type Material, Mesh, type Object3D, Points, Sprite } from "three";

/** Frees shapes and paints of `part` and all within it; shared textures stay. */
export function dispose(part: Object3D): void {
  part.traverse((one) => {
    if (!(one instanceof Mesh || one instanceof Points || one instanceof Sprite)) return;
    if (!(one instanceof Sprite)) one.geometry.dispose();
    if (one instanceof InstancedMesh) one.dispose();
    const paints: Material | Material[] = one.material;
    for (const paint of Array.isArray(paints) ? paints : [paints]) paint.dispose();
  });
}
