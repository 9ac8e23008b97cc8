// Off the page's thread: unpacks moments, undoes what made them small, and prepares the gas for drawing.
import {readMoment} from './moment.js';
import {gasForDrawing, setOptics} from './gas_data.js';

/** Packed moments by frame: small enough to keep all. @type {Map<number, Uint8Array>} */
const packed = new Map();

async function unpack(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/** Poses and numbers at once, for every frame. */
async function arrive({frame, bytes}) {
  packed.set(frame, bytes);
  const moment = readMoment(await unpack(bytes));
  const {poses, header} = moment;
  postMessage({kind: 'arrived', frame, bytes: bytes.length, header, poses}, Object.values(poses).map(a => a.buffer));
}

/** What weighs more, only of the frame that is looked at. */
async function show({frame}) {
  const bytes = packed.get(frame);
  if (!bytes) return;
  const moment = readMoment(await unpack(bytes));
  const gas = gasForDrawing(moment);
  const points = moment.points;
  const transfers = [];
  if (gas) transfers.push(gas.cells.buffer, gas.blocks.buffer);
  if (points) transfers.push(points.position.buffer, points.heat.buffer, points.kind.buffer);
  postMessage({kind: 'shown', frame, gas, points}, transfers);
}

const actions = {
  optics: message => setOptics(message.optics),
  arrive,
  show,
};
onmessage = async event => {
  try {
    await actions[event.data.kind](event.data);
  } catch (trouble) {
    postMessage({kind: 'trouble', frame: event.data.frame, text: String(trouble.message ?? trouble)});
  }
};
