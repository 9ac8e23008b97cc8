// Bundles the player into one page: node build.mjs OUT.html
import {build} from 'esbuild';
import {mkdirSync, readFileSync, renameSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {gzipSync} from 'node:zlib';

const sources = process.env.PLAYER_SOURCES ?? join(dirname(fileURLToPath(import.meta.url)), 'src');
const output = process.argv[2] ?? 'player.html';
const common = {
  bundle: true, minify: true, write: false, format: 'esm', target: 'es2022', legalComments: 'none', logLevel: 'warning',
  nodePaths: [join(dirname(fileURLToPath(import.meta.url)), 'node_modules')],
};

/** The worker as a text in the page's script: one file needs no other. */
const workerAsText = {
  name: 'worker-text',
  setup(builder) {
    builder.onResolve({filter: /^worker-text$/}, () => ({path: join(sources, 'worker.js'), namespace: 'worker-text'}));
    builder.onLoad({filter: /.*/, namespace: 'worker-text'}, async ({path}) => {
      const {outputFiles} = await build({...common, format: 'iife', entryPoints: [path]});
      return {contents: outputFiles[0].text, loader: 'text'};
    });
  },
};

const {outputFiles} = await build({...common, entryPoints: [join(sources, 'main.js')], plugins: [workerAsText]});
const script = outputFiles[0].text.replaceAll('</script', '<\\/script');
const page = readFileSync(join(sources, 'index.html'), 'utf8')
  .replace('/* style.css */', () => readFileSync(join(sources, 'style.css'), 'utf8'))
  .replace('/* main.js */', () => script);
mkdirSync(dirname(output), {recursive: true});
writeFileSync(`${output}.new`, page);
renameSync(`${output}.new`, output);
console.log(`${output}: script ${Math.round(script.length / 1000)} kB, ${Math.round(gzipSync(script, {level: 9}).length / 1000)} kB gzipped`);
