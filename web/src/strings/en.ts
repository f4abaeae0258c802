// Everything the browser says, in English. `zh.ts` has the same keys; a missing one does not compile.
export const en = {
  "app.name": "mirrorlimb",
  "app.disclaimer": "Research software, not a medical device.",
} as const;
