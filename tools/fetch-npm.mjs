// node fetch-npm.mjs FOLDER   downloads npm from its registry into FOLDER/package, unless it is already there.
// Exit 1 with a reason if this fails.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';

const version = '10.9.4'; // the last for Node 18
const integrity = 'OnUG836FwboQIbqtefDNlyR0gTHzIfwRfE3DuiNewBvnMnWEpB0VEXwBlFVgqpNzIgYo/MHh3d2Hel/pszapAA==';
const { npm_config_registry, NPM_CONFIG_REGISTRY } = process.env;
const registry = (npm_config_registry ?? NPM_CONFIG_REGISTRY ?? 'https://registry.npmjs.org').replace(/\/$/, '');
const folder = process.argv[2];

async function fetchNpm() {
  if (existsSync(`${folder}/package/.complete-${version}`)) return;
  const reply = await fetch(`${registry}/npm/-/npm-${version}.tgz`, { signal: AbortSignal.timeout(20000) });
  if (!reply.ok) throw new Error(`${reply.url}: ${reply.status}`);
  const archive = Buffer.from(await reply.arrayBuffer());
  if (createHash('sha512').update(archive).digest('base64') !== integrity) throw new Error(`${reply.url}: the checksum is not that of npm ${version}`);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  writeFileSync(`${folder}/npm.tgz`, archive);
  execFileSync('tar', ['-xzf', 'npm.tgz'], { cwd: folder });
  writeFileSync(`${folder}/package/.complete-${version}`, '');
}

fetchNpm().catch((wrong) => {
  console.error(`fetch-npm.mjs: ${wrong.message}${wrong.cause ? ` (${wrong.cause.message})` : ''}`);
  process.exit(1);
});
