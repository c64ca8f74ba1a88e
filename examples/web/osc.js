// OSC 1.0 as far as TUIO needs it: bundles of messages whose arguments are strings, integers and floats.

/** The messages of a packet, each { address, args }. Throws RangeError where it is cut short. */
export function* oscMessages(buffer, offset = 0, end = buffer.byteLength) {
  const reader = new Reader(buffer, offset, end);
  const head = reader.string();
  if (head !== "#bundle") {
    yield { address: head, args: reader.arguments() };
    return;
  }
  reader.skip(8);  // when the bundle is due: at once
  while (reader.offset < end) {
    const size = reader.integer();
    yield* oscMessages(buffer, reader.offset, reader.offset + size);
    reader.skip(size);
  }
}

class Reader {
  constructor(buffer, offset, end) {
    this.view = new DataView(buffer, 0, end);
    this.offset = offset;
  }
  skip(bytes) { this.offset += bytes; }
  integer() { return this.number(this.view.getInt32(this.offset)); }
  float() { return this.number(this.view.getFloat32(this.offset)); }
  number(value) {
    this.skip(4);
    return value;
  }
  string() {
    let text = "";
    for (let code; (code = this.view.getUint8(this.offset++)) !== 0;) text += String.fromCharCode(code);
    this.offset += -this.offset & 3;
    return text;
  }
  arguments() {
    const read = { s: () => this.string(), i: () => this.integer(), f: () => this.float() };
    return [...this.string().slice(1)].map((type) => read[type]());
  }
}
