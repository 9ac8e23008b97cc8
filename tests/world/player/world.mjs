// What the tests of the player share: the program, a small run, Chromium, and pictures.
import {execFileSync, spawn} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const skipped = 77;  // ctest: SKIP_RETURN_CODE

export const [binary, packages] = process.argv.slice(2);
export const here = dirname(fileURLToPath(import.meta.url));
export const chromiumFile = '/usr/bin/chromium';

export function skipWithout(file, advice) {
  if (existsSync(file)) return;
  console.log(`skipped: ${file} is not there; ${advice}`);
  process.exit(skipped);
}

/** A package of viewer/package-lock.json. */
export function load(name) { return createRequire(join(packages, 'package.json'))(name); }

export const place = mkdtempSync(join(tmpdir(), 'brisance_player_'));
process.on('exit', () => rmSync(place, {recursive: true, force: true}));

export function brisance(...words) { return execFileSync(binary, words, {encoding: 'utf8'}); }

export function smallRun() {
  const run = join(place, 'run');
  brisance('simulate', join(here, 'small.toml'), '-o', run, '--quiet');
  return run;
}

/** Serves a run; `url` and `stop`. */
export async function serve(run) {
  const server = spawn(binary, ['view', run, '--quiet'], {stdio: ['ignore', 'pipe', 'inherit']});
  const url = await new Promise((resolve, reject) => {
    server.stdout.once('data', text => resolve(String(text).trim()));
    server.once('exit', code => reject(new Error(`brisance view ended with ${code}`)));
  });
  server.removeAllListeners('exit');
  return {url, stop: () => new Promise(resolve => { server.once('exit', resolve); server.kill('SIGINT'); })};
}

export function launch(args = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']) {
  return load('playwright-core').chromium.launch({executablePath: chromiumFile, args: ['--no-sandbox', ...args]});
}

let failures = 0;
export function expect(isTrue, what) {
  console.log(`${isTrue ? 'ok    ' : 'FAILED'} ${what}`);
  if (!isTrue) ++failures;
}
export function finish() { process.exitCode = failures > 0 ? 1 : 0; }
