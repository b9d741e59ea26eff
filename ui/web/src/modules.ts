// What the unit tests see of the page; not part of the page itself.
export * from "./ballots";
export * from "./connection";
export * from "./format";
export * from "./handover";
export * from "./outline";
export * from "./places";
export * from "./presence";
export * from "./queue";
export * from "./session";
export * from "./timers";
export * from "./whole";
export * from "./words";
export * from "./words/de";
export * from "./words/en";
export * from "./words/ko";
export * from "./words/nl";
