// The patient's screen; its scene comes here.
export {};
