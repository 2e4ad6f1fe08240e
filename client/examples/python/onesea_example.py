#!/usr/bin/env python3
"""Joins a sea from Python with nothing but the proto files: lists sessions, watches the stream, asks for heights.

    python3 client/examples/python/onesea_example.py 127.0.0.1:7310 --seconds 3

Needs python3-grpcio, python3-protobuf, protobuf-compiler and protobuf-compiler-grpc (Debian), or pip's grpcio,
protobuf and grpcio-tools. The Python code of the messages is generated into a temporary folder at each start; a real
program generates it once.
"""

import argparse
import queue
import sys

import grpc

import onesea_messages

ACK_EVERY = 4  # frames; the server stops after `credit` frames that nobody acknowledged
CREDIT = 8


def list_sessions(stub, onesea_pb2):
    sessions = stub.ListSessions(onesea_pb2.ListSessionsRequest(), timeout=5).sessions
    for session in sessions:
        print(f"session {session.name}: tick {session.tick}, Hs {session.hs_m:.2f} m, {session.sea_name}")
    return sessions


def watch(stub, frame_pb2, session, seconds):
    """Reads the stream for some seconds and acknowledges every fourth frame. Answers the number of frames."""
    requests = queue.SimpleQueue()
    requests.put(frame_pb2.WatchRequest(open=frame_pb2.WatchRequest.Open(
        session=session, credit=CREDIT, every_frame=True, client_name="python example")))
    frames = stub.Watch(iter(requests.get, None), timeout=seconds)
    count = 0
    try:
        for frame in frames:
            count += 1
            if frame.HasField("welcome"):
                print(f"welcome: component hash {frame.welcome.component_hash:016x}")
            if frame.HasField("probes"):
                heights = ", ".join(f"{height:+.2f}" for height in frame.probes.height_m)
                print(f"tick {frame.probes.tick}: heights at the probes {heights} m")
            if count % ACK_EVERY == 0:
                ack = frame_pb2.WatchRequest.Ack(sequence=frame.sequence, drift_m=-1)
                requests.put(frame_pb2.WatchRequest(ack=ack))
    except grpc.RpcError as error:
        if error.code() != grpc.StatusCode.DEADLINE_EXCEEDED:  # the deadline is how we end
            raise
    finally:
        requests.put(None)
    print(f"{count} frames in {seconds:g} s")
    return count


def query(stub, query_pb2, session):
    """Heights and normals along a line to the east, now."""
    request = query_pb2.QueryPointsRequest(
        session=session, x_m=[0, 10, 20, 30], y_m=[0, 0, 0, 0],
        detail=query_pb2.QueryPointsRequest.DETAIL_NORMAL)
    answer = stub.QueryPoints(request, timeout=5)
    for x_m, height_m in zip(request.x_m, answer.height_m):
        print(f"height at ({x_m:g}, 0) at {answer.time_s:.3f} s: {height_m:+.3f} m")
    return answer


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("server", nargs="?", default="127.0.0.1:7310", help="HOST:PORT")
    parser.add_argument("--seconds", type=float, default=3.0, help="how long to watch")
    arguments = parser.parse_args()

    services, frame_pb2, onesea_pb2, query_pb2 = onesea_messages.load(
        "onesea_pb2_grpc", "frame_pb2", "onesea_pb2", "query_pb2")
    with grpc.insecure_channel(arguments.server) as channel:
        stub = services.OneSeaStub(channel)
        try:
            sessions = list_sessions(stub, onesea_pb2)
            if not sessions:
                sys.exit("the server has no session")
            watch(stub, frame_pb2, sessions[0].name, arguments.seconds)
            query(stub, query_pb2, sessions[0].name)
        except grpc.RpcError as error:
            sys.exit(f"{arguments.server}: {error.code().name}: {error.details()}")


if __name__ == "__main__":
    main()
