// Short names for the generated types of the service (schema.d.ts; `make types` renews it).
import type { components } from "./schema";

type Schemas = components["schemas"];

export type LiveMessage = Schemas["LiveMessage"];
