// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors
//
// Asks the Khronos validator about glTF files. usage: node tools/validate_gltf.mjs FILE...
// Exit status: 0 no error and no warning in any file, 1 some, 77 the validator is not installed (tools/setup node).
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const SHOWN = 10;
const severities = ['error', 'warning', 'information', 'hint'];
const root = dirname(dirname(fileURLToPath(import.meta.url)));

function loadValidator() {
    try {
        return createRequire(join(root, 'build', 'node', 'package.json'))('gltf-validator');
    } catch {
        console.error('the glTF validator is not installed; tools/setup node installs it');
        process.exit(77);
    }
}

async function complaints(validator, file) {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { uri: basename(file) });
    const { numErrors, numWarnings, messages } = report.issues;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
    for (const message of messages.filter((each) => each.severity < 2).slice(0, SHOWN))
        console.log(`  ${severities[message.severity]} ${message.code} at ${message.pointer}: ${message.message}`);
    return numErrors + numWarnings;
}

const files = process.argv.slice(2);
if (files.length === 0) {
    console.error('usage: node tools/validate_gltf.mjs FILE...');
    process.exit(2);
}
const validator = loadValidator();
let total = 0;
for (const file of files) total += await complaints(validator, file);
process.exit(total > 0 ? 1 : 0);
