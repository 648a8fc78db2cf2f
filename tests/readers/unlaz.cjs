// SPDX-License-Identifier: Apache-2.0
// Writes the points of a LAZ or COPC file as LAS, unpacked by the package laz-perf. Header and records stay as they are, less
// what only compressed files have. Usage: node unlaz.cjs IN.laz OUT.las
const fs = require("fs");
const { createLazPerf } = require("laz-perf");

const kVlrHeader = 54;
const kEvlrHeader = 60;
const kOnlyCompressed = ["laszip encoded", "copc"];

function fail(message) {
  process.stderr.write(`unlaz: ${message}\n`);
  process.exit(2);
}

// The variable length records from byte `at` on, each whole, less those of compressed files.
function records(file, at, count, headerSize) {
  const kept = [];
  for (let i = 0; i < count; ++i) {
    if (at + headerSize > file.length) fail("the file is truncated");
    const size = headerSize === kVlrHeader ? file.readUInt16LE(at + 20) : Number(file.readBigUInt64LE(at + 20));
    const user = file.toString("latin1", at + 2, at + 18).replace(/\0.*$/, "");
    if (!kOnlyCompressed.includes(user)) kept.push(file.subarray(at, at + headerSize + size));
    at += headerSize + size;
  }
  return kept;
}

function pointCount(file) {
  const count = file[25] >= 4 ? Number(file.readBigUInt64LE(247)) : 0;
  return count || file.readUInt32LE(107);
}

async function main(from, to) {
  const file = fs.readFileSync(from);
  if (file.toString("latin1", 0, 4) !== "LASF" || (file[104] & 0xc0) === 0) fail(`${from} is no LAZ file`);
  if (fs.existsSync(to)) fail(`${to} exists`);
  const headerSize = file.readUInt16LE(94);
  const recordSize = file.readUInt16LE(105);
  const count = pointCount(file);
  const header = Buffer.from(file.subarray(0, headerSize));
  const vlrs = records(file, headerSize, file.readUInt32LE(100), kVlrHeader);
  const is14 = file[25] >= 4;
  const evlrs = is14 ? records(file, Number(file.readBigUInt64LE(235)), file.readUInt32LE(243), kEvlrHeader) : [];
  const pointsAt = headerSize + vlrs.reduce((sum, vlr) => sum + vlr.length, 0);
  header[104] &= 0x3f;
  header.writeUInt32LE(pointsAt, 96);
  header.writeUInt32LE(vlrs.length, 100);
  if (is14) {
    header.writeBigUInt64LE(BigInt(evlrs.length ? pointsAt + count * recordSize : 0), 235);
    header.writeUInt32LE(evlrs.length, 243);
  }

  const lazPerf = await createLazPerf();
  const packed = lazPerf._malloc(file.length);
  const point = lazPerf._malloc(recordSize);
  lazPerf.HEAPU8.set(file, packed);
  const reader = new lazPerf.LASZip();
  reader.open(packed, file.length);
  const partial = `${to}.part`;
  const out = fs.openSync(partial, "w");
  for (const bytes of [header, ...vlrs]) fs.writeSync(out, bytes);
  const chunk = Buffer.alloc(65536 * recordSize);
  for (let begin = 0; begin < count; begin += 65536) {
    const points = Math.min(65536, count - begin);
    for (let i = 0; i < points; ++i) {
      reader.getPoint(point);
      chunk.set(lazPerf.HEAPU8.subarray(point, point + recordSize), i * recordSize);
    }
    fs.writeSync(out, chunk, 0, points * recordSize);
  }
  for (const bytes of evlrs) fs.writeSync(out, bytes);
  fs.closeSync(out);
  fs.renameSync(partial, to);
  process.stdout.write(`${to}: ${count} points\n`);
}

if (process.argv.length !== 4) fail("usage: unlaz IN.laz OUT.las");
main(process.argv[2], process.argv[3]).catch((error) => {
  fs.rmSync(`${process.argv[3]}.part`, { force: true });
  fail(`${process.argv[2]} cannot be unpacked: ${error.message || error}`);
});
