// A moment file, unpacked: a header in JSON and arrays that it names (docs/player.md).

/** A copy, so that it can go to another thread by itself. */
function array(Type, buffer, start, place, count) { return new Type(buffer, start + place, count).slice(); }

/** @param {ArrayBuffer} buffer */
export function readMoment(buffer) {
  const headerBytes = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, headerBytes)));
  const start = 4 + headerBytes;
  const take = (Type, place, count) => array(Type, buffer, start, place, count);
  const {poses: p, points: q, gas} = header;
  const moment = {header};
  moment.poses = {
    position: take(Float32Array, p.position, 3 * p.count),
    orientation: take(Int16Array, p.orientation, 4 * p.count),
    speed: take(Float32Array, p.speed, p.count),
    temperature: take(Float32Array, p.temperature, p.count),
    shape: take(Int16Array, p.shape, p.count),
  };
  if (q.count > 0)
    moment.points = {
      ...q,
      position: take(Uint16Array, q.position, 3 * q.count),
      heat: take(Uint8Array, q.heat, q.count),
      kind: take(Uint8Array, q.kind, q.count),
    };
  if (gas) {
    const cells = gas.size[0] * gas.size[1] * gas.size[2];
    moment.gas = {
      ...gas,
      density: asBytes(foretoldAgain(take(Uint8Array, gas.density, cells), gas.size), gas.densityLevels),
      heat: asBytes(foretoldAgain(take(Uint8Array, gas.heat, cells), gas.size), gas.heatLevels),
    };
  }
  return moment;
}

/** Levels 0 .. levels - 1 to 0 .. 255, in place. */
function asBytes(values, levels) {
  const byte = Uint8Array.from({length: 256}, (_, level) => Math.min(255, Math.round((255 * level) / (levels - 1))));
  for (let cell = 0; cell < values.length; ++cell) values[cell] = byte[values[cell]];
  return values;
}

/** Undoes the residuals of src/view/compact_gas.h, in place. @param {Uint8Array} values */
export function foretoldAgain(values, [width, height, depth]) {
  const slice = width * height;
  for (let k = 0; k < depth; ++k) {
    const base = k * slice;
    if (k > 0) values[base] += values[base - slice];
    for (let i = 1; i < width; ++i) values[base + i] += values[base + i - 1];
    for (let j = 1; j < height; ++j) {
      const row = base + j * width;
      let lowerLeft = values[row - width];
      let left = values[row] = values[row] + lowerLeft;
      left &= 255;
      for (let cell = row + 1, end = row + width; cell < end; ++cell) {
        const below = values[cell - width];
        const sum = left + below - lowerLeft;
        const least = left < below ? left : below, most = left < below ? below : left;
        const guess = sum < least ? least : sum > most ? most : sum;
        left = (values[cell] + guess) & 255;
        values[cell] = left;
        lowerLeft = below;
      }
    }
  }
  return values;
}
