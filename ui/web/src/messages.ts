// The messages between a room's server and its pages; made by `behaviourlinks schema --messages --typescript`.

/// What pages and windows say, by kind.
export interface FromPage {
  /** The first message of a connection: who comes, and what they have already. */
  hello: {
    t: "hello";
    /** Code of the room. */
    room: string;
    /** Random name of the life of this page or window; it numbers operations. */
    run: string;
    /** Key of an invitation, on the first visit. */
    invite?: string;
    /** Token of the seat, on later visits. */
    token?: string;
    /** `page`, `beamer` or `desktop`. A beamer that comes by the code only watches. */
    kind?: string;
    /** Language of the page, such as `en`. */
    lang?: string;
    /** Build of a window. */
    build?: string;
    /** What a window's build computes in its self-test. */
    fp?: string;
    /** Name of the person, where they were asked for it. */
    name?: string;
    /** Number of the last entry that was received. */
    have?: number;
    /** The tick that a window has reached; it goes on from there where that is possible. Without one it gets a snapshot. */
    tick?: number;
    /** Epoch of that number. */
    epoch?: number;
    /** Number of the last operation that has its answer. */
    unacked?: number;
    /** The views that are to be followed. */
    views?: string[];
  };
  /** A command. */
  op: {
    t: "op";
    /** Number of the operation in its run: 1, 2, 3, … without gaps. */
    id: number;
    /** Number of the last entry that the sender has seen. */
    base?: number;
    /** Commands of one gesture are undone together; 0 for a new one. */
    gesture?: number;
    /** {"command": id, "arguments": {…}}. */
    c: unknown;
    /** [{"key": place, "was": value}]: values that the sender has seen. */
    if?: unknown;
    /** The draft that it is a step of; empty for none. */
    draft?: string;
  };
  /** An event of the room. */
  room: {
    t: "room";
    /** Number of the operation in its run: 1, 2, 3, … without gaps. */
    id: number;
    /** {"event": id, "arguments": {…}}. */
    e: unknown;
  };
  /** Takes back the last gesture of one's own, or the named one. */
  undo: {
    t: "undo";
    /** Number of the operation in its run: 1, 2, 3, … without gaps. */
    id: number;
    /** A gesture of the log; 0 for the last one. */
    gesture?: number;
    /** The seat whose gesture it is, for facilitators; 0 for one's own. */
    of?: number;
  };
  /** Does again what was taken back last. */
  redo: {
    t: "redo";
    /** Number of the operation in its run: 1, 2, 3, … without gaps. */
    id: number;
    /** A gesture of the log; 0 for the last one. */
    gesture?: number;
  };
  /** Takes back everything since an entry, whoever did it; for facilitators. */
  rewind: {
    t: "rewind";
    /** Number of the operation in its run: 1, 2, 3, … without gaps. */
    id: number;
    /** The last entry that stays. */
    to: number;
  };
  /** Begins or drops a draft, takes its last step back, or brings the step back that was taken back last. */
  draft: {
    t: "draft";
    /** Number of the operation in its run: 1, 2, 3, … without gaps. */
    id: number;
    /** What happens to the draft. */
    do?: "begin" | "undo" | "redo" | "drop";
    /** Name of the draft. */
    draft: string;
    /** What a new draft is called. */
    title?: string;
  };
  /** The views that are to be followed from now on. */
  want: {
    t: "want";
    /** `room`, `plan`, `figures`, `card`, `votes`, `comments`, `proposals`, `drafts`, `draft_steps`, `draft_plans`, `keys`, `shapes`, `decisions`, `past`. */
    views: string[];
    /** The drafts that are on the screen, four at most: these are tried beside the room. */
    drafts?: string[];
  };
  /** How far a page has come. */
  seen: {
    t: "seen";
    /** Number of the last entry that it has shown. */
    s?: number;
    /** How late it was, in milliseconds. */
    lag?: number;
  };
  /** Asks whether the connection lives. */
  ping: {
    t: "ping";
    /** Comes back with the answer. */
    n?: number;
  };
  /** Where somebody is and what they hold; the newest counts, and nothing of it is stored. */
  presence: {
    t: "presence";
    /** Ascending. */
    n?: number;
    /** [x, y, z] in metres, or null. */
    cursor?: unknown;
    /** How a window looks at the scene, for those who follow it; null where it does not. */
    camera?: unknown;
    /** Ids of nodes that the person has selected. */
    holds?: string[];
    /** On where the page is not visible. */
    hidden?: boolean;
  };
  /** A window asks for a snapshot, because it can no longer follow the ticks from where it is. */
  resync: {
    t: "resync";
    /** The tick at which that was noticed. */
    k?: number;
    /** Number of the last entry that the window has; those behind it come before the snapshot. */
    have?: number;
    /** The server's hash of that tick, where hashes differ. */
    expected?: string;
    /** The window's own hash of it. */
    found?: string;
    /** `hash`, `late`, `entry`, or `values` where the window does not compute ticks at all. */
    why?: string;
  };
}

/// What the server says, by kind. Fields with their usual values are left out.
export interface FromServer {
  /** The answer to `hello`. */
  welcome: {
    t: "welcome";
    /** {seat, role, name, colour, areas, card}. */
    you: unknown;
    /** {code, title}. */
    room: unknown;
    /** {frame, text, queue}: sizes and numbers that are refused above. */
    limits: unknown;
    /** Changes where numbers of entries begin anew. */
    epoch: number;
    /** Number of the last entry that is stored. */
    seq: number;
    /** The tick. */
    tick: number;
    /** Ticks in a second. */
    rate: number;
    /** The last operation of this run that is answered. */
    done: number;
    /** `none` or `snapshot`: all views come anew. */
    resume?: string;
    /** For windows that have sent their self-test: `ticks` where it equals the server's, else `values`. */
    mode?: string;
    /** Where the room can be found: the addresses of this server, and of the laptops that follow it and have said theirs. */
    addresses?: string[];
    /** Opens the seat again; only on the first visit. */
    token?: string;
  };
  /** A scene with its running state, for windows that take the same ticks; what comes later goes on from it. */
  snapshot: {
    t: "snapshot";
    /** Number of the last entry that it holds. */
    s: number;
    /** Its tick. */
    k: number;
    /** The scene file with its state: deflated by zlib, in base 64. */
    scene: string;
    /** Bytes of the text. */
    size: number;
    /** A hash of the text. */
    digest: string;
  };
  /** Every entry that a tick has read is sent: a window may take the ticks up to this one. */
  tick: {
    t: "tick";
    /** The tick. */
    k: number;
    /** Number of the last entry that it has read. */
    s: number;
    /** Its hash, at least once in twenty ticks that were taken. */
    h?: string;
    /** A hash of the scene after the entry `s`, with `h` where nothing has been said since. */
    scene?: string;
    /** On where the ticks only count on from here, until somebody says something. */
    rest?: boolean;
  };
  /** The scene before the first entry, for windows; `ops` with all entries since follow. */
  scene: {
    t: "scene";
    /** Number of the last entry that it holds already. */
    s: number;
    /** The scene file. */
    scene: unknown;
  };
  /** Entries of the log, after they are stored. */
  ops: {
    t: "ops";
    /** [{s, k, a, g, c or v, by, d}]; a restart has `back`, the entry to whose running state it goes, and `state`, its hash. */
    e: unknown;
    /** Number of the last stored entry. */
    d: number;
    /** Grows with each return to a scenario: ticks go back. */
    epoch?: number;
  };
  /** The operation is stored. */
  ack: {
    t: "ack";
    /** Number of the operation in its run: 1, 2, 3, … without gaps. */
    id: number;
    /** Its entry. */
    s: number;
    /** The tick that reads it. */
    k: number;
  };
  /** The operation changed nothing. */
  nack: {
    t: "nack";
    /** Number of the operation in its run: 1, 2, 3, … without gaps. */
    id: number;
    /** One of a closed list of reasons. */
    why: string;
    /** Where. */
    place?: string;
    /** More about it, in English. */
    text?: string;
    /** What its sentence needs in other languages. */
    args?: unknown;
  };
  /** What has changed in a view; the first one of a view has all of it. */
  state: {
    t: "state";
    /** Name of the view. */
    view: string;
    /** The tick. */
    k: number;
    /** Number of the last entry that it knows. */
    s: number;
    /** Keys with their new content. */
    set: unknown;
    /** Keys that are gone. */
    drop?: string[];
    /** On where the message has all of the view. */
    whole?: boolean;
  };
  /** Who is where; only what has changed. */
  presence: {
    t: "presence";
    /** By seat; null for somebody who is gone. */
    seats: unknown;
  };
  /** A notice for people. */
  say: {
    t: "say";
    /** Which one; pages have the sentence. */
    id: string;
    /** What the sentence needs. */
    args?: unknown;
  };
  /** How the room and its computer are; for facilitators. What nobody knows is -1, or missing. */
  health: {
    t: "health";
    /** Duration of a tick, smoothed, in milliseconds. */
    tick_ms: number;
    /** Ticks that are taken in a second. */
    rate: number;
    /** Ticks in a second that the room wants. */
    wanted: number;
    /** On where the model has settled. */
    settled: boolean;
    /** The largest error of a demand, as a share of it. */
    worst: number;
    /** The node that has it. */
    worst_of?: string;
    /** Why the ticks have stopped. */
    failure?: string;
    /** Why nothing can be stored. */
    problem?: string;
    /** Duration of storing: half of the last hundred took no longer, in milliseconds. */
    disk_ms: number;
    /** The same of 95 in a hundred. */
    disk_slow_ms: number;
    /** The session file, as its computer finds it: minutes are made of it. */
    file?: string;
    /** Bytes of the session file. */
    journal: number;
    /** Seconds since the last snapshot was stored, since the room was opened. */
    snapshot_age: number;
    /** Laptops that follow the room. */
    followers: number;
    /** How full the battery is, from 0 to 1; -1 where there is none. */
    battery: number;
    /** Whether the computer is plugged in. */
    mains?: "unknown" | "yes" | "no";
    /** {INTERFACE: quality of its Wi-Fi link, from 0 to 1}. */
    wireless: unknown;
    /** Bytes of memory that programs may still take. */
    memory_free: number;
    /** Bytes that are free on the disk of the session file. */
    disk_free: number;
    /** {ADDRESS: how many other devices have come by it}. */
    reached: unknown;
    /** {FIGURE: `good`, `look` or `bad`}, of `ticks`, `disk`, `power`, `memory`, `space`, `wireless/INTERFACE` and `reached/ADDRESS`. */
    verdicts: unknown;
  };
  /** The connection lives. */
  pong: {
    t: "pong";
    /** Of the `ping`. */
    n: number;
    /** The tick. */
    k: number;
  };
}
