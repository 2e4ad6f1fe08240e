#!/usr/bin/env python3
"""Spawns a boat, reads where it is and steers it along a square: a robot's first hour, with nothing but the proto files.

    python3 client/examples/python/steer_square.py 127.0.0.1:7310 --side 40

The boat is one of the server's presets. Its motion comes as a stream of readings ten times a second, orders go back as
DriveBody. With --lock-step the session is held and stepped from here, so that every run is the same and as fast as the
machine; without, the boat sails in the session's own time. Needs what onesea_example.py needs.
"""

import argparse
import math
import sys
import uuid

import grpc

import onesea_messages

READINGS_PER_S = 10
THROTTLE = 0.35
LOOK_AHEAD_M = 7.0  # a point this far along the side is steered for: less is nervous, more cuts corners
TURN_BEFORE_M = 8.0  # the corner, about the radius of the boat's turn
GAIN = 2.5  # rudder per radian of heading error
DAMPING_S = 0.8  # and per rad/s of turning


def clamp(value, limit):
    return max(-limit, min(limit, value))


def wrapped(angle_rad):
    return math.remainder(angle_rad, 2.0 * math.pi)


class Square:
    """Its sides in order; counter-clockwise from a corner, the first side to the east."""

    def __init__(self, x_m, y_m, side_m):
        corners = [(x_m, y_m), (x_m + side_m, y_m), (x_m + side_m, y_m + side_m), (x_m, y_m + side_m)]
        self.side_m = side_m
        self.sides = [(corners[n], n * math.pi / 2.0) for n in range(4)]
        self.number = 0
        self.errors_m = []

    def done(self):
        return self.number == len(self.sides)

    def wanted_heading(self, x_m, y_m):
        """Goes on to the next side at a corner; notes how far off the line the boat is."""
        (from_x, from_y), heading = self.sides[self.number]
        along_m = (x_m - from_x) * math.cos(heading) + (y_m - from_y) * math.sin(heading)
        left_m = (y_m - from_y) * math.cos(heading) - (x_m - from_x) * math.sin(heading)
        last = self.number == len(self.sides) - 1
        if along_m >= self.side_m - (0.0 if last else TURN_BEFORE_M):
            self.number += 1
            if not self.done():
                return self.wanted_heading(x_m, y_m)
        self.errors_m.append(abs(left_m))
        return heading - math.atan2(left_m, LOOK_AHEAD_M)


class Boat:
    """The calls that a robot needs, for one boat of one session."""

    def __init__(self, stub, messages, session, preset, place):
        self.stub, self.session = stub, session
        self.command_pb2, self.onesea_pb2 = messages
        request = self.command_pb2.SpawnBodyRequest(command=self._command())
        request.body.preset = preset
        request.body.name = "square"
        request.body.owner = "steer_square.py"
        request.start.position_m.x, request.start.position_m.y = place  # z = 0: afloat
        spawned = stub.SpawnBody(request, timeout=10)
        self.id, self.lease = spawned.body_id, spawned.lease
        print(f"body {self.id}: {preset}, {spawned.body.mass_kg:g} kg, {len(spawned.body.thrusters)} thruster(s)")

    def _command(self, lease=""):
        # A new id for each command: a retry with the same one would be harmless.
        return self.command_pb2.Command(session=self.session, request_id=uuid.uuid4().hex, lease=lease)

    def leave_a_wake(self):
        request = self.command_pb2.AddRegionRequest(command=self._command())
        request.region.follow_body_id = self.id
        request.region.rest_after_s = 60  # who leaves gives it back
        self.stub.AddRegion(request, timeout=10)

    def motions(self, ticks_per_reading):
        """A stream of readings, each a list: position (3), turn (w, x, y, z), velocity (3), spin (3)."""
        request = self.command_pb2.StreamInstrumentsRequest(session=self.session, ticks_per_reading=ticks_per_reading)
        request.instruments.add().motion.body_id = self.id
        stream = self.stub.StreamInstruments(request)
        stream.initial_metadata()  # it has begun: no tick is missed from here on
        return stream

    def drive(self, throttle, rudder):
        self.stub.DriveBody(self.command_pb2.DriveBodyRequest(
            command=self._command(self.lease), body_id=self.id, throttle=[throttle], rudder=[rudder]), timeout=10)

    def remove(self):
        self.stub.RemoveBody(self.command_pb2.RemoveBodyRequest(command=self._command(self.lease), body_id=self.id),
                             timeout=10)

    def step(self, ticks):
        self.stub.StepSession(self.onesea_pb2.StepSessionRequest(session=self.session, ticks=ticks), timeout=60)


def sail(boat, square, tick_rate_hz, seconds_max, lock_step):
    """Steers until the square is done; answers the sea seconds that it took, or None."""
    ticks = max(1, tick_rate_hz // READINGS_PER_S)
    stream = boat.motions(ticks)
    if lock_step:
        boat.step(ticks)
    first_tick = None
    for reading in stream:
        first_tick = first_tick or reading.tick
        seconds = (reading.tick - first_tick) / tick_rate_hz
        x, y, _, w, qx, qy, z = reading.values[:7]
        spin_up = reading.values[12]
        heading = math.atan2(2.0 * (w * z + qx * qy), 1.0 - 2.0 * (qy * qy + z * z))
        wanted = square.wanted_heading(x, y)
        if square.done() or seconds > seconds_max:
            boat.drive(0.0, 0.0)
            stream.cancel()
            return seconds if square.done() else None
        # Positive turns to port, as headings count.
        boat.drive(THROTTLE, clamp(GAIN * wrapped(wanted - heading) - DAMPING_S * spin_up, 1.0))
        if lock_step:
            boat.step(ticks)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("server", nargs="?", default="127.0.0.1:7310", help="HOST:PORT")
    parser.add_argument("--session", help="default: the server's first")
    parser.add_argument("--preset", default="boat", help="onesea presets lists them")
    parser.add_argument("--side", type=float, default=40.0, help="metres")
    parser.add_argument("--at", default="0,0", help="X,Y of the first corner")
    parser.add_argument("--seconds", type=float, default=300.0, help="of the sea, then it is given up")
    parser.add_argument("--lock-step", action="store_true", help="hold the session and step it from here")
    arguments = parser.parse_args()
    place = tuple(float(part) for part in arguments.at.split(","))

    services, command_pb2, onesea_pb2 = onesea_messages.load("onesea_pb2_grpc", "command_pb2", "onesea_pb2")
    with grpc.insecure_channel(arguments.server) as channel:
        stub = services.OneSeaStub(channel)
        try:
            sessions = stub.ListSessions(onesea_pb2.ListSessionsRequest(), timeout=5).sessions
            named = [s for s in sessions if arguments.session in (None, s.name)]
            if not named:
                sys.exit(f"no such session; there are: {', '.join(s.name for s in sessions)}")
            session = named[0]
            if arguments.lock_step:
                stub.HoldSession(onesea_pb2.HoldSessionRequest(session=session.name), timeout=5)
            boat = Boat(stub, (command_pb2, onesea_pb2), session.name, arguments.preset, place)
            square = Square(*place, arguments.side)
            try:
                boat.leave_a_wake()
                seconds = sail(boat, square, session.tick_rate_hz, arguments.seconds, arguments.lock_step)
            finally:
                boat.remove()
                if arguments.lock_step:
                    stub.ResumeSession(onesea_pb2.ResumeSessionRequest(session=session.name), timeout=5)
        except grpc.RpcError as error:
            sys.exit(f"{arguments.server}: {error.code().name}: {error.details()}")
    rms_m = math.sqrt(sum(error * error for error in square.errors_m) / len(square.errors_m))
    print(f"track error: {rms_m:.2f} m rms, {max(square.errors_m):.2f} m at most, corners included")
    if seconds is None:
        sys.exit(f"gave up on side {square.number + 1} of 4 after {arguments.seconds:g} s")
    print(f"square of {arguments.side:g} m done in {seconds:.1f} s")


if __name__ == "__main__":
    main()
