// SPDX-License-Identifier: Apache-2.0
// Reads an MCAP file of ROS 2 with @mcap/core, messages with Foxglove's CDR reader by the
// definitions in the file itself. read_mcap.mjs MCAP OUT: writes what read_bag.py writes of a bag.
import { open, writeFile } from "node:fs/promises";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { readFile } from "node:fs/promises";

const FIELDS = ["x", "y", "z", "intensity", "ring", "time", "return_number", "return_count", "class",
  "plot", "plant"];

const timeOf = (stamp) => [stamp.sec, stamp.nanosec ?? stamp.nsec];
const split = (ns) => [Number(ns / 1000000000n), Number(ns % 1000000000n)];
const headerOf = (header) => ({ stamp: timeOf(header.stamp), frame: header.frame_id });
const xyz = (v) => [v.x, v.y, v.z];
const xyzw = (v) => [v.x, v.y, v.z, v.w];

const describe = {
  "rosgraph_msgs/msg/Clock": (m) => ({ clock: timeOf(m.clock) }),
  "tf2_msgs/msg/TFMessage": (m) => ({
    transforms: m.transforms.map((t) => ({
      ...headerOf(t.header), child: t.child_frame_id,
      translation: xyz(t.transform.translation), rotation: xyzw(t.transform.rotation),
    })),
  }),
  "sensor_msgs/msg/Imu": (m) => ({
    ...headerOf(m.header), orientation: xyzw(m.orientation),
    angular_velocity: xyz(m.angular_velocity), linear_acceleration: xyz(m.linear_acceleration),
  }),
  "sensor_msgs/msg/NavSatFix": (m) => ({
    ...headerOf(m.header), status: m.status.status, service: m.status.service,
    fix: [m.latitude, m.longitude, m.altitude],
  }),
  "velodyne_msgs/msg/VelodyneScan": (m) => ({
    ...headerOf(m.header),
    packets: m.packets.map((p) => ({ stamp: timeOf(p.stamp), data: Array.from(p.data) })),
  }),
  "sensor_msgs/msg/PointCloud2": (m) => ({
    ...headerOf(m.header), height: m.height, width: m.width, point_step: m.point_step,
    row_step: m.row_step, bytes: m.data.length, is_dense: m.is_dense,
    fields: m.fields.map((f) => [f.name, f.offset, f.datatype, f.count]),
  }),
};

const readers = {
  2: (view, at) => view.getUint8(at), 4: (view, at) => view.getUint16(at, true),
  6: (view, at) => view.getUint32(at, true), 7: (view, at) => view.getFloat32(at, true),
};

function appendPoints(rows, cloud, index) {
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const fields = FIELDS.map((name) => cloud.fields.find((f) => f.name === name));
  for (let i = 0; i < cloud.width; ++i) {
    rows.push(index);
    for (const f of fields) rows.push(readers[f.datatype](view, i * cloud.point_step + f.offset));
  }
}

// Every record from the file's beginning, whose checksums are checked on the way.
async function checkStream(path) {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(await readFile(path));
  const counts = {};
  for (let record; (record = reader.nextRecord()); ) counts[record.type] = (counts[record.type] ?? 0) + 1;
  if (!reader.done()) throw new Error("the file does not end with its footer");
  return counts;
}

async function main(path, out) {
  const file = await open(path);
  const { size } = await file.stat();
  const readable = {
    size: async () => BigInt(size),
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      await file.read(buffer, 0, Number(length), Number(offset));
      return buffer;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  const topics = {};
  const decoders = new Map();
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    const qos = channel.metadata.get("offered_qos_profiles");
    topics[channel.topic] = {
      type: schema.name, schema_encoding: schema.encoding, encoding: channel.messageEncoding, qos,
      latched: /durability: 1\n/.test(qos),
      count: Number(reader.statistics.channelMessageCounts.get(channel.id)),
    };
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    decoders.set(channel.id, [schema.name, new MessageReader(definition)]);
  }
  const messages = [];
  const rows = [];
  let clouds = 0;
  for await (const message of reader.readMessages()) {
    const [type, decoder] = decoders.get(message.channelId);
    const decoded = decoder.readMessage(message.data);
    messages.push({
      topic: reader.channelsById.get(message.channelId).topic, log: split(message.logTime),
      ...describe[type](decoded),
    });
    if (type === "sensor_msgs/msg/PointCloud2") appendPoints(rows, decoded, clouds++);
  }
  const document = {
    topics, messages, profile: reader.header.profile, records: await checkStream(path),
    message_count: Number(reader.statistics.messageCount),
  };
  await writeFile(out + ".json", JSON.stringify(document));
  await writeFile(out + ".points", Buffer.from(new Float64Array(rows).buffer));
}

await main(process.argv[2], process.argv[3]);
