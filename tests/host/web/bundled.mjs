// Loads a module of the page in node: esbuild makes plain script of it, in a folder that is removed at the
// end.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readdirSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

export const web = fileURLToPath(new URL('../../../host/web/', import.meta.url));

const folder = mkdtempSync(join(tmpdir(), 'unicursal-web-'));
process.on('exit', () => rmSync(folder, {recursive: true, force: true}));

export async function bundled(name) {
  const file = join(folder, `${name}.mjs`);
  execFileSync(
      process.env.ESBUILD ?? 'esbuild',
      [join(web, `${name}.ts`), '--bundle', '--format=esm', '--log-level=warning', `--outfile=${file}`]);
  return import(pathToFileURL(file).href);
}

/** All scripts of the page, by their name. */
export function sources() {
  const names = ['.', 'views'].flatMap(
      (under) => readdirSync(join(web, under))
                     .filter((name) => name.endsWith('.ts'))
                     .map((name) => join(under, name)));
  return new Map(names.map((name) => [name, readFileSync(join(web, name), 'utf8')]));
}
