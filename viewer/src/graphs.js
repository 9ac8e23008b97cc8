// The run's balances over its frames, and how hard the solver worked.

const palette = {in: '#ffb454', gained: '#6fb7ff', out: '#8fd694', lost: '#e2739b', value: '#ffb454'};

const sumOf = seconds => Object.values(seconds).reduce((sum, s) => sum + s, 0);
const balance = name => ({
  of: report => ({in: report[name].in, gained: report[name].gained, out: report[name].out, lost: report[name].lost}),
  adds: true,
});

export const graphs = {
  volume: {title: 'Volume of gas', unit: 'm³', ...balance('volume')},
  heat: {title: 'Heat above ambient', unit: 'J', ...balance('heat')},
  seconds: {title: 'Work for a frame', unit: 's', of: report => ({value: sumOf(report.seconds)})},
  iterations: {title: 'Pressure iterations', unit: '', of: report => ({value: report.iterations})},
  courant: {title: 'Largest Courant number', unit: '', of: report => ({value: report.courant})},
  error: {title: 'Divergence error', unit: '', of: report => ({value: report.divergence})},
};

export function shortNumber(x) {
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size >= 1e9) return `${(x / 1e9).toPrecision(3)} G`;
  if (size >= 1e6) return `${(x / 1e6).toPrecision(3)} M`;
  if (size >= 1e4) return `${(x / 1e3).toPrecision(3)} k`;
  if (size >= 0.01) return String(+x.toPrecision(3));
  return x.toExponential(1);
}

/** Series of a graph over the known moments; gaps where one is missing. */
export function seriesOf(graph, known) {
  const series = {}, sums = {};
  known.forEach((moment, place) => {
    if (!moment) return;
    for (const [name, value] of Object.entries(graph.of(moment.header.report))) {
      const shown = graph.adds ? (sums[name] = (sums[name] ?? 0) + value) : value;
      (series[name] ??= []).push([place, shown]);
    }
  });
  return series;
}

/** @param {HTMLCanvasElement} canvas */
export function drawGraph(canvas, graph, known, count, place) {
  const ratio = Math.min(window.devicePixelRatio, 2);
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (width === 0) return {};
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const pen = canvas.getContext('2d', {willReadFrequently: true});  // drawn without the card, which is busy
  pen.scale(ratio, ratio);
  const series = seriesOf(graph, known), values = Object.values(series).flatMap(line => line.map(point => point[1]));
  let least = Math.min(0, ...values), most = Math.max(0, ...values);
  if (most === least) most = least + 1;
  const x = n => 1 + (n / Math.max(count - 1, 1)) * (width - 2);
  const y = v => height - 4 - ((v - least) / (most - least)) * (height - 8);
  pen.strokeStyle = 'rgba(255,255,255,0.14)';
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(0, y(0));
  pen.lineTo(width, y(0));
  pen.stroke();
  const now = {};
  for (const [name, line] of Object.entries(series)) {
    pen.strokeStyle = palette[name];
    pen.lineWidth = 1.5;
    pen.lineJoin = 'round';
    pen.beginPath();
    line.forEach(([n, v], k) => {
      if (k === 0 || line[k - 1][0] !== n - 1) pen.moveTo(x(n), y(v));
      else pen.lineTo(x(n), y(v));
      if (n === place) now[name] = v;
    });
    pen.stroke();
    if (name in now) {
      pen.fillStyle = palette[name];
      pen.beginPath();
      pen.arc(x(place), y(now[name]), 2.6, 0, 7);
      pen.fill();
    }
  }
  pen.fillStyle = 'rgba(255,255,255,0.4)';
  pen.fillRect(x(place) - 0.5, 0, 1, height);
  return now;
}

export const colourOfSeries = name => palette[name];
