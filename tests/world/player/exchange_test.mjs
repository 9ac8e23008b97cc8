// Exports in the hands of others: the Khronos validator for glTF, three.js' loader for USD.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {brisance, expect, finish, load, packages, place, serve, smallRun} from './world.mjs';

const run = smallRun();

async function validated(name, bytes) {
  const {issues} = await load('gltf-validator').validateBytes(new Uint8Array(bytes));
  expect(issues.numErrors === 0 && issues.numWarnings === 0,
    `${name}: ${issues.numErrors} errors, ${issues.numWarnings} warnings ${JSON.stringify(issues.messages.filter(({severity}) => severity < 2).slice(0, 3))}`);
}

async function gltfIsValid() {
  const film = join(place, 'film.glb');
  brisance('export', run, '--to', 'gltf', '-o', film, '--quiet');
  await validated('the film as glTF', readFileSync(film));
  await validated('pieces.glb of the run', readFileSync(join(run, 'pieces.glb')));
  const server = await serve(run);
  await validated('the pieces that the player is served', await (await fetch(`${server.url}data/pieces.glb`)).arrayBuffer());
  await server.stop();
  await validatorFindsFaults(readFileSync(film));
}

/** The judge is awake. */
async function validatorFindsFaults(bytes) {
  const text = bytes.toString('latin1').replace('"VEC3"', '"VEC9"');
  const {issues} = await load('gltf-validator').validateBytes(new Uint8Array(Buffer.from(text, 'latin1')));
  expect(issues.numErrors > 0, 'a spoilt glTF is found');
}

async function usdIsRead() {
  const layer = join(place, 'film.usda');
  brisance('export', run, '--to', 'usd', '-o', layer, '--quiet');
  const loaders = createRequire(join(packages, 'package.json')).resolve('three/examples/jsm/loaders/USDLoader.js');
  const {USDLoader} = await import(pathToFileURL(loaders));
  const scene = new USDLoader().parse(readFileSync(layer, 'utf8'));
  const bodies = JSON.parse(readFileSync(join(run, 'bodies/bodies.0001.json'), 'utf8')).bodies;
  scene.updateMatrixWorld(true);
  const places = new Map();
  scene.traverse(node => places.set(node.name, node));
  for (const {name, position} of bodies) {
    const node = places.get(name.replace('.', '_'));
    const at = node ? [node.matrixWorld.elements[12], node.matrixWorld.elements[13], node.matrixWorld.elements[14]] : [NaN];
    expect(at.every((x, axis) => Math.abs(x - position[axis]) < 1e-5), `USD has ${name} in its place ${at.map(x => x.toFixed(4))}`);
    let triangles = 0;
    node?.traverse(mesh => { if (mesh.isMesh) triangles += (mesh.geometry.index ?? mesh.geometry.attributes.position).count / 3; });
    expect(triangles > 0, `and its mesh of ${triangles} triangles`);
  }
  const moving = new Set((scene.animations ?? []).flatMap(clip => clip.tracks.map(track => track.name.split('.')[0])));
  expect(moving.size >= 6, `${moving.size} bodies have tracks`);
}

try {
  await gltfIsValid();
  await usdIsRead();
} catch (trouble) {
  expect(false, trouble.stack);
}
finish();
