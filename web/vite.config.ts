// How the browser side is built: two pages, the therapist's dashboard and the patient's screen.
import { defineConfig } from "vitest/config";

const service = "http://127.0.0.1:8000";

export default defineConfig({
  build: {
    outDir: "../server/api/static",
    emptyOutDir: true,
    // three alone is larger than vite's default warning; it is loaded by the patient's screen only.
    chunkSizeWarningLimit: 900,
    rolldownOptions: { input: { dashboard: "index.html", play: "play.html" } },
  },
  // `npm run dev` serves the pages itself and asks a running station for everything else.
  server: {
    host: "127.0.0.1",
    proxy: {
      "/api": { target: service, ws: true },
      "/view3d": { target: service, ws: true },
      "/replay3d": { target: service, ws: true },
    },
  },
  test: { include: ["src/**/*.test.ts"] },
});
