// What is wrong with the text of a STEP file (ISO 10303-21). web-ifc passes over it in silence or without an end, and so
// makes shapes that are not those of the model.
'use strict';

const [HASH, QUOTE, DOUBLE_QUOTE, ZERO, NINE, SEMICOLON, EQUALS, SLASH, STAR, OPEN, CLOSE, DOT, LINE] =
    [...'#\'"09;=/*().\n'].map(c => c.charCodeAt(0));

function isDigit(byte) { return byte >= ZERO && byte <= NINE; }
function isWord(byte) { return isDigit(byte) || (byte >= 65 && byte <= 90) || (byte >= 97 && byte <= 122) || byte === 95; }

/** Goes through the entities of a file and calls define(id), refer(from, to) and fault(id, line, what). */
class StepScan {
  constructor(bytes, calls) {
    this.bytes = bytes;
    this.calls = {define() {}, refer() {}, fault() {}, ...calls};
  }
  run() {
    const {bytes} = this;
    this.line = 1;
    this.begin();
    for (this.at = 0; this.at < bytes.length; ++this.at) {
      const byte = bytes[this.at];
      if (byte === SLASH && bytes[this.at + 1] === STAR) {
        this.skipComment();
        continue;
      }
      if (byte === LINE) ++this.line;
      else if (byte === QUOTE || byte === DOUBLE_QUOTE) this.skipPast(byte);
      else if (byte === SEMICOLON) this.end();
      else if (byte === HASH && isDigit(bytes[this.at + 1])) this.number();
      else if (byte === OPEN) ++this.depth;
      else if (byte === CLOSE) this.close();
      else if (byte === DOT && this.entity && isDigit(bytes[this.at + 1]) && !isWord(bytes[this.at - 1]))
        this.calls.fault(this.entity, this.line, 'has a number that begins with its point');
      if (byte > 32 && byte !== SEMICOLON) this.fresh = false;
    }
  }
  begin() {
    this.entity = 0;
    this.depth = 0;
    this.parts = 0;  // lists of attributes; more than one only within an outer pair of parentheses
    this.fresh = true;
  }
  skipPast(quote) {
    while (++this.at < this.bytes.length && this.bytes[this.at] !== quote)
      if (this.bytes[this.at] === LINE) ++this.line;
  }
  skipComment() {
    for (this.at += 2; this.at < this.bytes.length; ++this.at) {
      if (this.bytes[this.at] === LINE) ++this.line;
      if (this.bytes[this.at] === SLASH && this.bytes[this.at - 1] === STAR) return;
    }
  }
  number() {
    let id = 0;
    while (isDigit(this.bytes[this.at + 1])) id = 10 * id + this.bytes[++this.at] - ZERO;
    let next = this.at + 1;
    while (this.bytes[next] <= 32) ++next;
    if (this.fresh && this.bytes[next] === EQUALS) {
      this.entity = id;
      this.calls.define(id);
    } else if (this.entity) {
      this.calls.refer(this.entity, id);
    }
  }
  close() {
    if (--this.depth === 0) ++this.parts;
    if (this.depth < 0 && this.entity) this.calls.fault(this.entity, this.line, 'closes a parenthesis that is not open');
  }
  end() {
    if (this.entity && (this.depth !== 0 || this.parts !== 1))
      this.calls.fault(this.entity, this.line, 'has not one list of attributes in parentheses');
    this.begin();
  }
}

/** The first entity whose text is malformed: {id, line, what}; undefined where there is none. */
function malformedEntity(bytes) {
  let first;
  new StepScan(bytes, {fault: (id, line, what) => { first ??= {id, line, what}; }}).run();
  return first;
}

/** A Map from each entity that reaches a missing one, by whatever way, to the missing one. */
function brokenEntities(bytes) {
  const defined = new Set(), broken = new Map(), open = [];
  new StepScan(bytes, {define: id => defined.add(id)}).run();
  new StepScan(bytes, {refer: (from, to) => {
    if (defined.has(to) || broken.has(from)) return;
    broken.set(from, to);
    open.push(from);
  }}).run();
  if (!open.length) return broken;
  const users = new Map();
  new StepScan(bytes, {refer: (from, to) => {
    if (!users.has(to)) users.set(to, []);
    users.get(to).push(from);
  }}).run();
  while (open.length) {
    const id = open.pop();
    for (const user of users.get(id) ?? []) {
      if (broken.has(user)) continue;
      broken.set(user, broken.get(id));
      open.push(user);
    }
  }
  return broken;
}

module.exports = {malformedEntity, brokenEntities};
