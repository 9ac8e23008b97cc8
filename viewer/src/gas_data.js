// The gas as the graphics card wants it: cells, and a coarse grid over them that says what light arrives in each block
// and which blocks are empty. Lights that the fire is for everything else.

/** Cells along each edge of a block. */
export const blockCells = 4;
const fireLights = 4;

let optics = null;
/** @param {{gas: object, heat: object, sun: number[] | null}} given sun: the way to it */
export function setOptics(given) {
  optics = given;
  // Opacity per metre of each density byte (src/render/gas_medium.h, GasOptics::extinction).
  const {opacity, minDensity, maxDensity} = given.gas;
  optics.extinction = Float32Array.from({length: 256}, (_, byte) => {
    const share = (byte / 255) ** 2, t = Math.min(share * 100, 1);
    return opacity * (minDensity * t * t * (3 - 2 * t) + (maxDensity - minDensity) * share);
  });
}

const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** A coarse grid of numbers. */
class Blocks {
  constructor(size) {
    this.size = size.map(n => Math.ceil(n / blockCells));
    this.count = this.size[0] * this.size[1] * this.size[2];
    this.strides = [1, this.size[0], this.size[0] * this.size[1]];
  }
  grid() { return new Float32Array(this.count); }
}

/** Means of extinction and glow, and the largest density, of each block. */
function summarise(gas, blocks) {
  const [nx, ny, nz] = gas.size, [sy, sz] = [blocks.strides[1], blocks.strides[2]];
  const extinction = blocks.grid(), glow = blocks.grid(), largest = new Uint8Array(blocks.count);
  const glowOf = Float32Array.from(optics.heat.colours, colour => luminance(colour) * optics.gas.emission);
  for (let k = 0, cell = 0; k < nz; ++k)
    for (let j = 0; j < ny; ++j) {
      const row = (k >> 2) * sz + (j >> 2) * sy;
      for (let i = 0; i < nx; ++i, ++cell) {
        const density = gas.density[cell];
        if (density === 0) continue;
        const block = row + (i >> 2), kappa = optics.extinction[density];
        extinction[block] += kappa;
        glow[block] += kappa * glowOf[gas.heat[cell]];
        if (density > largest[block]) largest[block] = density;
      }
    }
  const share = 1 / blockCells ** 3;
  for (let block = 0; block < blocks.count; ++block) {
    extinction[block] *= share;
    glow[block] *= share;
  }
  return {extinction, glow, largest};
}

/** For every block the mean over six directions of the share of light that arrives. */
function fromAllAround(extinction, blocks, edge) {
  const arriving = blocks.grid();
  for (let axis = 0; axis < 3; ++axis)
    for (const way of [1, -1]) {
      const n = blocks.size[axis], stride = blocks.strides[axis] * way;
      for (let block = 0; block < blocks.count; ++block) {
        const place = Math.floor(block / blocks.strides[axis]) % n;
        if (way === 1 ? place !== 0 : place !== n - 1) continue;
        let depth = 0;
        for (let step = 0, at = block; step < n; ++step, at += stride) {
          const half = 0.5 * extinction[at] * edge;
          depth += half;
          arriving[at] += Math.exp(-depth) / 6;
          depth += half;
        }
      }
    }
  return arriving;
}

/** The share of sunlight that arrives in each block: a walk towards it, block by block. */
function fromTheSun(extinction, blocks, edge, sun) {
  const arriving = blocks.grid().fill(1);
  if (!sun) return arriving;
  const longest = Math.max(...sun.map(Math.abs)), step = sun.map(s => s / longest);
  const length = edge * Math.hypot(...step);
  const [nx, ny, nz] = blocks.size;
  for (let block = 0, k = 0; k < nz; ++k)
    for (let j = 0; j < ny; ++j)
      for (let i = 0; i < nx; ++i, ++block) {
        let depth = 0.5 * extinction[block] * length;
        for (let n = 1; depth < 6; ++n) {
          const x = Math.round(i + n * step[0]), y = Math.round(j + n * step[1]), z = Math.round(k + n * step[2]);
          if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz) break;
          depth += extinction[x + nx * (y + ny * z)] * length;
        }
        arriving[block] = Math.exp(-depth);
      }
  return arriving;
}

/** Spread to the neighbours along an axis, some times. */
function spread(values, blocks, times) {
  let from = values, to = blocks.grid();
  for (let n = 0; n < times; ++n)
    for (let axis = 0; axis < 3; ++axis) {
      const stride = blocks.strides[axis], size = blocks.size[axis];
      for (let block = 0; block < blocks.count; ++block) {
        const place = Math.floor(block / stride) % size;
        const lower = place > 0 ? from[block - stride] : 0, upper = place < size - 1 ? from[block + stride] : 0;
        to[block] = 0.25 * lower + 0.5 * from[block] + 0.25 * upper;
      }
      [from, to] = [to, from];
    }
  return from;
}

/** The fire as a few lights: along the two longest axes each half of the fire is one. */
function lightsOf({extinction, glow}, gas, blocks, arriving) {
  const lights = Array.from({length: fireLights}, () => ({place: [0, 0, 0], intensity: 0}));
  const edge = gas.cell * blockCells, corner = gas.origin.map(o => o + 0.5 * (edge - gas.cell));
  const axes = [0, 1, 2].sort((a, b) => gas.size[b] - gas.size[a]).slice(0, 2);
  const middle = [0, 0, 0];
  let sum = 0;
  const visit = action => {
    for (let block = 0, k = 0; k < blocks.size[2]; ++k)
      for (let j = 0; j < blocks.size[1]; ++j)
        for (let i = 0; i < blocks.size[0]; ++i, ++block)
          if (glow[block] > 0) action(glow[block] * arriving[block] * edge ** 3, [i, j, k]);
  };
  visit((light, at) => {
    sum += light;
    at.forEach((place, axis) => { middle[axis] += light * place; });
  });
  if (sum <= 0) return [];
  visit((light, at) => {
    const part = lights[(at[axes[0]] * sum > middle[axes[0]] ? 1 : 0) + (at[axes[1]] * sum > middle[axes[1]] ? 2 : 0)];
    part.intensity += light;
    at.forEach((place, axis) => { part.place[axis] += light * place; });
  });
  return lights.filter(light => light.intensity > 0).map(({place, intensity}) => ({
    intensity,
    place: place.map((p, axis) => corner[axis] + (p / intensity) * edge),
  }));
}

const byteOf = share => Math.max(0, Math.min(255, Math.round(255 * share)));

/** @returns cells: two bytes a cell (density, heat); blocks: four bytes a block (light from all around, sunlight, glow of
    the fire around, largest density here and in the neighbours); null without gas */
export function gasForDrawing({gas}) {
  if (!gas) return null;
  const count = gas.density.length, cells = new Uint8Array(2 * count);
  for (let cell = 0; cell < count; ++cell) {
    cells[2 * cell] = gas.density[cell];
    cells[2 * cell + 1] = gas.heat[cell];
  }
  const blocks = new Blocks(gas.size), edge = gas.cell * blockCells;
  const summary = summarise(gas, blocks);
  const around = fromAllAround(summary.extinction, blocks, edge);
  const sun = fromTheSun(summary.extinction, blocks, edge, optics.sun);
  const fire = spread(summary.glow.map(g => g * edge), blocks, 3);
  const occupied = largestAround(summary.largest, blocks);
  const bytes = new Uint8Array(4 * blocks.count);
  for (let block = 0; block < blocks.count; ++block) {
    bytes[4 * block] = byteOf(around[block]);
    bytes[4 * block + 1] = byteOf(sun[block]);
    bytes[4 * block + 2] = byteOf(fire[block] / (1 + fire[block]));
    bytes[4 * block + 3] = occupied[block];
  }
  return {
    size: gas.size, origin: gas.origin, cell: gas.cell, cells,
    blockSize: blocks.size, blocks: bytes,
    lights: lightsOf(summary, gas, blocks, around),
  };
}

/** Between cells the next block's rim counts as well. */
function largestAround(largest, blocks) {
  let from = largest, to = new Uint8Array(blocks.count);
  for (let axis = 0; axis < 3; ++axis) {
    const stride = blocks.strides[axis], size = blocks.size[axis];
    for (let block = 0; block < blocks.count; ++block) {
      const place = Math.floor(block / stride) % size;
      to[block] = Math.max(from[block], place > 0 ? from[block - stride] : 0, place < size - 1 ? from[block + stride] : 0);
    }
    [from, to] = [to, axis === 0 ? new Uint8Array(blocks.count) : from];
  }
  return from;
}
