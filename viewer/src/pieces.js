// All bodies as a few meshes, one for each material: a vertex knows its body, and a small picture has every body's pose.
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, FloatType, GLSL3, LinearMipmapNearestFilter, Mesh, NearestFilter, NoColorSpace, RawShaderMaterial,
  RGBAFormat, Vector3, Vector4,
} from 'three';
import {GLTFLoader} from 'three/examples/jsm/loaders/GLTFLoader.js';
import {pieceFragment, pieceVertex} from './shaders.js';

const perBody = 3;  // texels: place and whether it is there; orientation; speed, temperature, hue, whether it moves
const goldenRatio = 0.618033988749895;

/** The picture of what has none: one program for all is compiled once. */
const white = new DataTexture(new Uint8Array([255, 255, 255, 255]), 1, 1, RGBAFormat);
white.needsUpdate = true;

/** @param {Uint8Array} bytes binary glTF @returns {Promise<{name: string, meshes: Mesh[]}[]>} in the order of the nodes */
export async function readBodies(bytes) {
  const {buffer} = bytes.byteOffset === 0 && bytes.byteLength === bytes.buffer.byteLength ? bytes : bytes.slice();
  const {scene} = await new GLTFLoader().parseAsync(buffer, '');
  return scene.children.map(node => ({
    name: node.userData.name ?? node.name,
    meshes: node.isMesh ? [node] : node.children.filter(child => child.isMesh),
  }));
}

function poseTexture(bodies) {
  const texture = new DataTexture(new Float32Array(4 * perBody * bodies), perBody, bodies, RGBAFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  return texture;
}

export class Pieces {
  /** @param {{name: string, moves: boolean}[]} bodies in the order of the poses
      @param {boolean} isPlain what is not glass has no glints: a third of its work */
  constructor(bodies, isPlain) {
    this.bodies = bodies;
    this.isPlain = isPlain;
    this.numbers = new Map(bodies.map(({name}, number) => [name, number]));
    this.parts = [];   // {body, mesh, first, count} vertices of a body in one of the meshes
    this.solids = [];  // meshes
    this.glasses = [];
    this.textures = [poseTexture(bodies.length), poseTexture(bodies.length)];
    this.shapes = new Int16Array(bodies.length);
    this.middle = new Vector3();
    this.uniforms = {
      poses: {value: this.textures[0]}, posesNext: {value: this.textures[1]}, blend: {value: 0}, explode: {value: 0},
      middle: {value: this.middle}, colouring: {value: 0}, ranges: {value: new Vector3(1, 293, 294)},
      solidDepth: {value: null}, eye: {value: new Vector3()}, ambient: {value: new Vector3()}, sky: {value: new Vector3()},
      sunWays: {value: [new Vector3(0, 1, 0), new Vector3(0, 1, 0)]}, sunLights: {value: [new Vector3(), new Vector3()]},
      sunCount: {value: 0}, lampCount: {value: 0},
      lamps: {value: Array.from({length: 6}, () => new Vector4())},
      lampLights: {value: Array.from({length: 6}, () => new Vector3())},
    };
  }

  /** @param read what readBodies returns */
  load(read) {
    const byMaterial = new Map();
    for (const {name, meshes} of read) {
      const body = this.numbers.get(name);
      if (body === undefined) continue;
      for (const mesh of meshes) {
        // Walls are kept from pieces so that they can be hidden.
        const key = `${mesh.material.uuid} ${this.bodies[body].moves}`;
        if (!byMaterial.has(key)) byMaterial.set(key, {material: mesh.material, moves: this.bodies[body].moves, members: []});
        byMaterial.get(key).members.push({body, mesh});
      }
    }
    for (const group of byMaterial.values()) this.addGroup(group);
  }

  addGroup({material, moves, members}) {
    const count = members.reduce((sum, {mesh}) => sum + mesh.geometry.attributes.position.count, 0);
    const position = new Float32Array(3 * count), normal = new Float32Array(3 * count), uv = new Float32Array(2 * count);
    const body = new Float32Array(count), index = [];
    const isGlass = material.transmission > 0;
    const mesh = new Mesh(new BufferGeometry(), this.materialFor(material, isGlass));
    let first = 0;
    for (const {body: number, mesh: {geometry}} of members) {
      const {position: p, normal: n, uv: t} = geometry.attributes;
      position.set(p.array.subarray(0, 3 * p.count), 3 * first);
      if (n) normal.set(n.array.subarray(0, 3 * n.count), 3 * first);
      if (t) uv.set(t.array.subarray(0, 2 * t.count), 2 * first);
      body.fill(number, first, first + p.count);
      if (geometry.index) for (const corner of geometry.index.array) index.push(first + corner);
      else for (let corner = 0; corner < p.count; ++corner) index.push(first + corner);
      this.parts.push({body: number, mesh, first, count: p.count});
      first += p.count;
    }
    mesh.geometry.setAttribute('position', new BufferAttribute(position, 3));
    mesh.geometry.setAttribute('normal', new BufferAttribute(normal, 3));
    mesh.geometry.setAttribute('uv', new BufferAttribute(uv, 2));
    mesh.geometry.setAttribute('body', new BufferAttribute(body, 1));
    mesh.geometry.setIndex(index);
    mesh.frustumCulled = false;  // where it is only the poses know
    mesh.userData.moves = moves;
    (isGlass ? this.glasses : this.solids).push(mesh);
  }

  materialFor(material, isGlass) {
    const picture = material.map ?? material.emissiveMap;
    if (picture) {
      picture.colorSpace = NoColorSpace;  // the shader decodes it
      picture.minFilter = LinearMipmapNearestFilter;
      picture.needsUpdate = true;
    }
    const emission = (material.emissive ?? new Color(0, 0, 0)).clone().multiplyScalar(material.emissiveIntensity ?? 1);
    const isInside = /inside/.test(material.name);
    const shine = 1 - (material.roughness ?? 1);
    const made = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: pieceVertex, fragmentShader: pieceFragment, side: material.side,
      defines: isGlass ? {GLASS: 1} : this.isPlain ? {PLAIN: 1} : {},
      uniforms: {
        ...this.uniforms,
        picture: {value: picture ?? white}, edge: {value: isInside ? 1 : 0},
        colour: {value: material.color ?? new Color(0.7, 0.7, 0.7)}, emission: {value: emission},
        shine: {value: 0.25 * Math.max(0, shine)},
      },
    });
    made.userData.isGlass = isGlass;
    return made;
  }

  /** Bodies that took another shape in a frame: the vertices stay as many. */
  async reshape(bytes) {
    const bodies = await readBodies(bytes);
    for (const {name, meshes} of bodies) {
      const parts = this.parts.filter(part => part.body === this.numbers.get(name));
      meshes.forEach((mesh, n) => {
        const from = mesh.geometry.attributes, part = parts[n];
        if (!part || part.count !== from.position.count) return;
        for (const attribute of ['position', 'normal']) {
          if (!from[attribute]) continue;
          const to = part.mesh.geometry.attributes[attribute];
          to.array.set(from[attribute].array, 3 * part.first);
          to.needsUpdate = true;
        }
      });
    }
  }

  /** @param {object} poses of a moment @param {0 | 1} which this frame, or the next */
  setPoses(poses, which) {
    const texture = this.textures[which], data = texture.image.data, n = this.bodies.length;
    for (let body = 0; body < n; ++body) {
      const at = 4 * perBody * body;
      for (let axis = 0; axis < 3; ++axis) data[at + axis] = poses.position[axis * n + body];
      data[at + 3] = poses.shape[body] >= 0 ? 1 : 0;
      for (let part = 0; part < 4; ++part) data[at + 4 + part] = poses.orientation[part * n + body] / 32767;
      data[at + 8] = poses.speed[body];
      data[at + 9] = poses.temperature[body];
      data[at + 10] = (body * goldenRatio) % 1;
      data[at + 11] = this.bodies[body].moves ? 1 : 0;
    }
    texture.needsUpdate = true;
  }

  /** From where the exploded view goes out: the middle of what moves. */
  setMiddle(poses) {
    const n = this.bodies.length, sum = [0, 0, 0];
    let count = 0;
    for (let body = 0; body < n; ++body) {
      if (!this.bodies[body].moves || poses.shape[body] < 0) continue;
      ++count;
      for (let axis = 0; axis < 3; ++axis) sum[axis] += poses.position[axis * n + body];
    }
    if (count > 0) this.middle.set(...sum.map(s => s / count));
  }

  /** Coloured pieces are not glass: they hide what is behind them. */
  setColouring(mode) {
    this.uniforms.colouring.value = mode;
    this.glassIsSolid = mode > 0;
  }
}
