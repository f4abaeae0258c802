// Keeps the scene of the game that is being played: opened when the game's name changes, and until it has been fetched
// the picture before stays.
import { Group } from "three";
import type { Changes, GameView } from "./changes";
import type { Side } from "./hand-shape";
import type { GameScene, OpenScene } from "./scene";

/** After a failed fetch (a broken connection) it is tried again so much later. */
const RETRY_MS = 2000;

export type FindScene = (game: string) => (() => Promise<OpenScene>) | null;

export class SceneKeeper {
  readonly group = new Group();
  /** The game whose scene is on the stage. */
  shown = "";
  private readonly known = new Map<string, OpenScene>();
  private readonly fetching = new Set<string>();
  private scene: GameScene | null = null;
  private wanted = "";
  private side: Side = "right";

  /** `onOpen` is called with each scene that takes the stage. */
  constructor(
    private readonly find: FindScene,
    private readonly onOpen: (scene: GameScene) => void,
  ) {}

  get current(): GameScene | null {
    return this.scene;
  }

  /** The game that is wanted has no scene on this page: the service is newer than the page. */
  get isUnknown(): boolean {
    return this.find(this.wanted) === null;
  }

  /** Makes the scene of `game` the one that is shown, as soon as it can be. */
  want(game: string, side: Side): void {
    if (game !== this.wanted || side !== this.side) this.begin(game, side);
  }

  /** The same, for a game that begins: nothing of another one stays on the stage. */
  begin(game: string, side: Side): void {
    this.wanted = game;
    this.side = side;
    this.open();
  }

  /** Fetches the scene of a game that comes later. */
  fetch(game: string): void {
    const load = this.find(game);
    if (!load || this.known.has(game) || this.fetching.has(game)) return;
    this.fetching.add(game);
    load().then(
      (open) => this.arrived(game, open),
      () => setTimeout(() => this.fetchAgain(game), RETRY_MS),
    );
  }

  /** Gives the picture to the scene, if it is that game's; says where something was won. */
  show(view: GameView, changes: Changes): ReturnType<GameScene["show"]> {
    return this.scene && this.shown === view.game ? this.scene.show(view, changes) : [];
  }

  private fetchAgain(game: string): void {
    this.fetching.delete(game);
    if (game === this.wanted) this.fetch(game);
  }

  private arrived(game: string, open: OpenScene): void {
    this.fetching.delete(game);
    this.known.set(game, open);
    if (game === this.wanted) this.open();
  }

  private open(): void {
    const open = this.known.get(this.wanted);
    if (!open) {
      this.fetch(this.wanted);
      return;
    }
    this.scene?.close();
    this.group.clear();
    this.scene = open(this.side);
    this.shown = this.wanted;
    this.group.add(this.scene.group);
    this.onOpen(this.scene);
  }
}
