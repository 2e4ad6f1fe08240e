// Joins a sea from Node with nothing but the proto files: lists sessions, watches the stream, asks for heights.
//
//   npm ci --prefix client/examples/node
//   node client/examples/node/onesea_example.js 127.0.0.1:7310 3

import grpc from '@grpc/grpc-js';
import protoLoader from '@grpc/proto-loader';
import {fileURLToPath} from 'node:url';

const ACK_EVERY = 4;  // frames; the server stops after `credit` frames that nobody acknowledged
const CREDIT = 8;

function connect(address) {
  const protoRoot = fileURLToPath(new URL('../../../proto', import.meta.url));
  const definition = protoLoader.loadSync('onesea/v1/onesea.proto', {
    includeDirs: [protoRoot],
    keepCase: true,
    longs: String,  // hashes and ticks are 64 bits wide, numbers of JavaScript 53
    enums: String,
    defaults: true,
    oneofs: true,
  });
  const {OneSea} = grpc.loadPackageDefinition(definition).onesea.v1;
  return new OneSea(address, grpc.credentials.createInsecure());
}

// A unary call as a promise, with a deadline.
function call(client, method, request) {
  return new Promise((resolve, reject) => {
    client[method](request, {deadline: Date.now() + 5000}, (error, answer) => {
      if (error) reject(error);
      else resolve(answer);
    });
  });
}

async function listSessions(client) {
  const {sessions} = await call(client, 'ListSessions', {});
  for (const session of sessions) {
    console.log(`session ${session.name}: tick ${session.tick}, Hs ${session.hs_m.toFixed(2)} m, ${session.sea_name}`);
  }
  return sessions;
}

// Reads the stream for some seconds, acknowledges every fourth frame, answers the number of frames.
function watch(client, session, seconds) {
  return new Promise((resolve, reject) => {
    const stream = client.Watch();
    let count = 0;
    stream.on('data', (frame) => {
      count += 1;
      if (frame.welcome) {
        const hash = BigInt(frame.welcome.component_hash).toString(16).padStart(16, '0');
        console.log(`welcome: component hash ${hash}`);
      }
      if (frame.probes) {
        const heights = frame.probes.height_m.map((height) => height.toFixed(2)).join(', ');
        console.log(`tick ${frame.probes.tick}: heights at the probes ${heights} m`);
      }
      if (count % ACK_EVERY === 0) stream.write({ack: {sequence: frame.sequence, drift_m: -1}});
    });
    stream.on('error', (error) => {
      if (error.code !== grpc.status.CANCELLED) reject(error);  // cancelling is how we end
      else resolve(count);
    });
    stream.on('end', () => resolve(count));
    stream.write({open: {session, credit: CREDIT, every_frame: true, client_name: 'node example'}});
    setTimeout(() => stream.cancel(), seconds * 1000);
  });
}

// Heights along a line to the east, now.
async function query(client, session) {
  const x_m = [0, 10, 20, 30];
  const answer = await call(client, 'QueryPoints', {session, x_m, y_m: x_m.map(() => 0), detail: 'DETAIL_NORMAL'});
  x_m.forEach((x, n) => {
    console.log(`height at (${x}, 0) at ${answer.time_s.toFixed(3)} s: ${answer.height_m[n].toFixed(3)} m`);
  });
}

const [address = '127.0.0.1:7310', seconds = '3'] = process.argv.slice(2);
const client = connect(address);
try {
  const sessions = await listSessions(client);
  if (sessions.length === 0) throw new Error('the server has no session');
  const count = await watch(client, sessions[0].name, Number(seconds));
  console.log(`${count} frames in ${seconds} s`);
  await query(client, sessions[0].name);
} catch (error) {
  console.error(`${address}: ${error.message}`);
  process.exitCode = 1;
} finally {
  client.close();
}
