// What the unit tests see of the page; not part of the page itself.
export * from "./connection";
export * from "./queue";
