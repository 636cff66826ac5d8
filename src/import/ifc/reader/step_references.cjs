// References of a STEP file that lead nowhere. web-ifc passes over them in silence, and so makes
// shapes that are not those of the model.
'use strict';

const HASH = 35, QUOTE = 39, ZERO = 48, NINE = 57, SEMICOLON = 59, EQUALS = 61, SLASH = 47, STAR = 42;

function isDigit(byte) { return byte >= ZERO && byte <= NINE; }

/** Calls define(id) and refer(from, to) for each entity and each reference of the bytes. */
function scan(bytes, define, refer) {
  let entity = 0, fresh = true;
  for (let i = 0; i < bytes.length; ++i) {
    const byte = bytes[i];
    if (byte === QUOTE) {
      while (++i < bytes.length && bytes[i] !== QUOTE) {}
    } else if (byte === SLASH && bytes[i + 1] === STAR) {
      for (i += 2; i < bytes.length && !(bytes[i] === STAR && bytes[i + 1] === SLASH);) ++i;
    } else if (byte === SEMICOLON) {
      fresh = true;
      entity = 0;
    } else if (byte === HASH && isDigit(bytes[i + 1])) {
      let id = 0;
      while (isDigit(bytes[i + 1])) id = 10 * id + bytes[++i] - ZERO;
      if (fresh) {
        let next = i + 1;
        while (bytes[next] <= 32) ++next;
        if (bytes[next] === EQUALS) {
          entity = id;
          define(id);
        }
      } else if (entity) {
        refer(entity, id);
      }
      fresh = false;
    }
  }
}

/** Returns a Map from each entity that reaches a missing one, by whatever way, to the missing one. */
function brokenEntities(bytes) {
  const defined = new Set();
  scan(bytes, id => defined.add(id), () => {});
  const broken = new Map(), open = [];
  scan(bytes, () => {}, (from, to) => {
    if (!defined.has(to) && !broken.has(from)) {
      broken.set(from, to);
      open.push(from);
    }
  });
  if (!open.length) return broken;
  const users = new Map();
  scan(bytes, () => {}, (from, to) => {
    if (!users.has(to)) users.set(to, []);
    users.get(to).push(from);
  });
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

module.exports = {brokenEntities};
