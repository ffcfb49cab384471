// check.mjs - reads a log with the MCAP project's own library, to test Sinew's writer with a reader
// other than Sinew's own.
//
//   npm ci
//   node check.mjs whole runs/walk/1/log.mcap    a finished log: index, statistics, every message
//   node check.mjs cut FILE                      a log that was cut off: the rest can be read
//
// Exit code 0: correct, 1: not correct (one line gives the reason), 2: wrong usage.
import { readFile } from "node:fs/promises";
import { crc32 } from "@foxglove/crc";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

const text = new TextDecoder("utf-8", { fatal: true });

class Failure extends Error {}

function expect(condition, message) {
  if (!condition) throw new Failure(message);
}

// Schemas by number, channels by number, and for each message: does its content match its schema?
class Messages {
  #schemas = new Map();
  #channels = new Map();
  counts = new Map(); // channel -> messages
  steady = new Map(); // channel whose value never changes -> the topic that has its times
  total = 0;

  addSchema(schema) {
    expect(schema.encoding === "jsonschema", `schema ${schema.name} is ${schema.encoding}`);
    const json = JSON.parse(text.decode(schema.data));
    expect(json.type === "object", `schema ${schema.name} is not that of an object`);
    expect(typeof json.description === "string", `schema ${schema.name} has no description`);
    for (const [name, property] of Object.entries(json.properties)) {
      expect(property.type === "number", `${schema.name}.${name} is ${property.type}`);
      expect(typeof property.unit === "string", `${schema.name}.${name} has no unit`);
    }
    this.#schemas.set(schema.id, json.properties);
  }

  addChannel(channel) {
    const properties = this.#schemas.get(channel.schemaId);
    expect(properties, `channel ${channel.topic} has no schema`);
    expect(channel.messageEncoding === "json", `${channel.topic} is ${channel.messageEncoding}`);
    // A reader that does not parse schemas finds the units in the channel's metadata.
    for (const [name, property] of Object.entries(properties)) {
      const unit = channel.metadata.get(`unit.${name}`);
      expect(unit === property.unit, `${channel.topic}.${name} is in ${property.unit} and in ${unit}`);
    }
    this.#channels.set(channel.id, { topic: channel.topic, fields: Object.keys(properties) });
    const times = channel.metadata.get("sinew.steady");
    if (times !== undefined) this.steady.set(channel.id, times);
  }

  addMessage(message) {
    const channel = this.#channels.get(message.channelId);
    expect(channel, `message on unknown channel ${message.channelId}`);
    const count = this.counts.get(message.channelId) ?? 0;
    const where = `${channel.topic} message ${count}`;
    expect(message.logTime === message.publishTime, `${where}: two different times`);
    const json = JSON.parse(text.decode(message.data));
    const names = Object.keys(json);
    expect(
      names.length === channel.fields.length && names.every((n, i) => n === channel.fields[i]),
      `${where}: fields ${names} instead of ${channel.fields}`,
    );
    for (const [name, value] of Object.entries(json))
      expect(value === null || typeof value === "number", `${where}: ${name} is ${typeof value}`);
    this.counts.set(message.channelId, count + 1);
    ++this.total;
  }

  topicOf(id) {
    return this.#channels.get(id).topic;
  }

  get channels() {
    return this.#channels.size;
  }
}

const readable = (bytes) => ({
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
});

function checkStatistics(reader, messages, first, last) {
  const s = reader.statistics;
  expect(s, "no statistics");
  const same = (name, found, said) =>
    expect(BigInt(found) === BigInt(said), `statistics: ${name} ${said}, found ${found}`);
  same("messages", messages.total, s.messageCount);
  same("channels", messages.channels, s.channelCount);
  same("schemas", reader.schemasById.size, s.schemaCount);
  same("chunks", reader.chunkIndexes.length, s.chunkCount);
  same("metadata", reader.metadataIndexes.length, s.metadataCount);
  same("first time", first, s.messageStartTime);
  same("last time", last, s.messageEndTime);
  for (const [channel, count] of s.channelMessageCounts)
    same(`messages of channel ${channel}`, messages.counts.get(channel) ?? 0, count);
}

// A value that never changes is written once, and the topic that has its times is complete.
function checkSteady(messages) {
  const counts = new Map();
  for (const [id, count] of messages.counts) counts.set(messages.topicOf(id), count);
  for (const [id, times] of messages.steady) {
    const topic = messages.topicOf(id);
    expect(counts.get(topic) === 1, `${topic} never changes and is there ${counts.get(topic)} times`);
    expect((counts.get(times) ?? 0) > 1, `${topic} has the times of ${times}, which has none`);
  }
}

async function checkWhole(bytes) {
  const reader = await McapIndexedReader.Initialize({ readable: readable(bytes) });
  expect(/^sinew\b/.test(reader.header.library), `written by "${reader.header.library}"`);
  const messages = new Messages();
  for (const schema of reader.schemasById.values()) messages.addSchema(schema);
  for (const channel of reader.channelsById.values()) messages.addChannel(channel);

  let first = 0n;
  let last = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    if (messages.total === 0) first = message.logTime;
    expect(message.logTime >= last, "the index gives messages out of order");
    last = message.logTime;
    messages.addMessage(message);
  }
  checkStatistics(reader, messages, first, last);
  checkSteady(messages);
  expect(
    crc32(bytes.subarray(0, Number(reader.dataEndOffset))) === reader.dataSectionCrc,
    "the data's checksum is wrong",
  );

  const names = [];
  for await (const metadata of reader.readMetadata()) names.push(metadata.name);
  expect(names.includes("sinew.run"), `no metadata "sinew.run", only [${names}]`);

  // Read from front to back it must be the same log.
  const stream = readStream(bytes);
  expect(stream.done, "read as a stream it has no end");
  expect(stream.messages.total === messages.total, `as a stream ${stream.messages.total} messages`);
  return `${messages.total} messages, ${messages.channels} channels, ${messages.steady.size} of them steady, ${reader.chunkIndexes.length} chunks`;
}

function readStream(bytes) {
  const reader = new McapStreamReader({ validateCrcs: true });
  const messages = new Messages();
  reader.append(bytes);
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") messages.addSchema(record);
    if (record.type === "Channel") messages.addChannel(record);
    if (record.type === "Message") messages.addMessage(record);
  }
  return { messages, done: reader.done(), left: reader.bytesRemaining() };
}

async function checkCut(bytes) {
  const { messages, done, left } = readStream(bytes);
  expect(!done, "this log is whole; expected one that was cut off");
  expect(messages.total > 0, "nothing can be read");
  return `${messages.total} messages, ${messages.channels} channels, ${left} bytes of a torn record`;
}

const checks = { whole: checkWhole, cut: checkCut };
const [kind, file] = process.argv.slice(2);
if (!checks[kind] || !file) {
  console.error("usage: node check.mjs whole|cut FILE");
  process.exit(2);
}
try {
  console.log(`${file}: ${await checks[kind](await readFile(file))}`);
} catch (error) {
  console.error(`${file}: ${error.message}`);
  process.exit(1);
}
