// SPDX-License-Identifier: Apache-2.0
// Reads a LAS file with the package copc and prints it as JSON: header, variable length records,
// and of every point all that its format and its extra bytes hold. Usage: node read_las.cjs FILE.las
const fs = require("fs");
const { Las } = require("copc");

async function main(path) {
  const file = fs.readFileSync(path);
  const get = async (begin, end) => file.subarray(begin, end);
  const header = Las.Header.parse(file.subarray(0, 375));
  const vlrs = await Las.Vlr.walk(get, header);
  const content = async (user, record) => {
    const vlr = Las.Vlr.find(vlrs, user, record);
    return vlr && (await Las.Vlr.fetch(get, vlr));
  };
  const extra = await content("LASF_Spec", 4);
  const wkt = await content("LASF_Projection", 2112);
  const extraBytes = extra ? Las.ExtraBytes.parse(extra) : [];
  const begin = header.pointDataOffset;
  const end = begin + header.pointCount * header.pointDataRecordLength;
  const view = Las.View.create(file.subarray(begin, end), header, extraBytes);
  const points = {};
  for (const name of Object.keys(view.dimensions)) {
    const get_value = view.getter(name);
    points[name] = Array.from({ length: view.pointCount }, (_, i) => get_value(i));
  }
  const text = wkt ? Buffer.from(wkt).toString().replace(/\0+$/, "") : "";
  process.stdout.write(JSON.stringify({ header, extraBytes, wkt: text, points, size: file.length, end }));
}

main(process.argv[2]);
