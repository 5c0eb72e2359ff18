# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""What the tests with nodes share: waiting, recording, and vehicles that fly every trajectory perfectly."""

import json
import math
import os
import signal
import threading
import time
import xmlrpc.client

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from swarm_planner.msg import ObstacleTrack, ObstacleTrackArray, PlannerStatus, SwarmPlan
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import MultiDOFJointTrajectory

# Wall time that anything may take on a slow, busy machine [s].
PATIENCE = 40.0


def wait_for(condition, what, timeout=PATIENCE):
    """Returns the first true value of condition(); fails the test after `timeout` seconds of wall time."""
    end = time.time() + timeout
    while time.time() < end and not rospy.is_shutdown():
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError('waited in vain for ' + what)


def node_api(name):
    """The XML-RPC interface of a node; raises if there is none."""
    return xmlrpc.client.ServerProxy(rosgraph.Master('/test').lookupNode(rospy.resolve_name(name)))


def kill_node(name):
    """kill -9"""
    os.kill(node_api(name).getPid('/test')[2], signal.SIGKILL)


def wait_for_summary(path, timeout=PATIENCE):
    """The summary that quad_sim_node writes at the end of a run."""

    def read():
        if not os.path.exists(path):
            return None
        with open(path) as file:
            line = file.readline()
        return json.loads(line) if line.endswith('\n') else None

    return wait_for(read, 'the summary of the run', timeout)


class Recorder:
    """Keeps every message of a topic, and in `arrivals` the ROS time at which each came."""

    def __init__(self, topic, message_type):
        self._lock = threading.Lock()
        self._messages = []
        self.arrivals = []
        self._subscriber = rospy.Subscriber(topic, message_type, self._receive, tcp_nodelay=True)

    def _receive(self, message):
        with self._lock:
            self._messages.append(message)
            self.arrivals.append(rospy.Time.now())

    def all(self):
        with self._lock:
            return list(self._messages)

    def count(self):
        with self._lock:
            return len(self._messages)

    def clear(self):
        with self._lock:
            self._messages = []
            self.arrivals = []

    def last(self):
        with self._lock:
            return self._messages[-1] if self._messages else None

    def newest(self):
        """The last message; waits for the first one, as other nodes may be connected before this one is."""
        return wait_for(self.last, 'a message on ' + self._subscriber.resolved_name)

    def wait_for_more(self, count, timeout=PATIENCE):
        """Waits for `count` further messages and returns them."""
        before = self.count()
        wait_for(lambda: self.count() >= before + count,
                 '%d messages on %s' % (count, self._subscriber.resolved_name), timeout)
        return self.all()[before:]


class Planner:
    """What planner_node tells."""

    def __init__(self, name='planner_node'):
        self.status = Recorder(name + '/status', PlannerStatus)
        self.plans = Recorder(name + '/plans', SwarmPlan)

    def uav(self, name):
        """The newest status of a UAV, or None."""
        status = self.status.last()
        return next((uav for uav in status.uavs if uav.name == name), None) if status else None

    def wait_for_uav(self, name, condition, what):
        def holds():
            uav = self.uav(name)
            return uav if uav and condition(uav) else None
        return wait_for(holds, '%s of %s' % (what, name))

    def wait_for_start(self):
        return wait_for(lambda: self.status.last() and self.status.last().started and self.status.last(),
                        'the start of the run')


class Diagnostics:
    """What nodes say of their health. A name may lack the node's before it."""

    def __init__(self):
        self._recorder = Recorder('/diagnostics', DiagnosticArray)

    def clear(self):
        self._recorder.clear()

    def entries(self, name):
        """All that there have been of a name, the newest last."""
        return [status for array in self._recorder.all() for status in array.status
                if status.name == name or status.name.endswith(': ' + name)]

    def entry(self, name):
        """The newest of a name, or None."""
        return next(reversed(self.entries(name)), None)

    def told(self, name):
        """As entries(): (level, message)."""
        return [(each.level, each.message) for each in self.entries(name)]

    def said(self, text):
        """Whether any entry has had `text` in its message."""
        return any(text in status.message for array in self._recorder.all() for status in array.status)

    def wait_for(self, name, level, text):
        """Until the newest entry of the name is of this level and contains the text."""
        def says():
            entry = self.entry(name)
            return entry if entry and entry.level == level and text in entry.message else None
        return wait_for(says, 'diagnostics of "%s" that say: %s' % (name, text))

    @staticmethod
    def _value(status, key):
        values = {each.key: each.value for each in status.values} if status else {}
        return int(values.get(key, 0))

    def count(self, name, key):
        """The value of a counter; 0 as long as it has not been published."""
        return self._value(self.entry(name), key)

    def settled_count(self, name, key):
        """The same once nothing that was sent before is on its way any more: three reports in a row agree."""
        begin = len(self.entries(name))

        def settled():
            last = [self._value(status, key) for status in self.entries(name)[begin:]][-3:]
            return last if len(last) == 3 and len(set(last)) == 1 else None
        return wait_for(settled, '"%s" of %s to stay the same' % (key, name))[-1]

    def wait_for_count(self, name, key, more_than, publish=lambda: None):
        """Publishes until the count has grown."""
        def grown():
            publish()
            rospy.sleep(0.1)
            return self.count(name, key) > more_than
        wait_for(grown, '"%s" of %s above %d' % (key, name, more_than))

    def wait_for_counts(self, name, key, items):
        """`items`: pairs of a cause and what publishes a message with it. Each is counted under its cause; it is sent
        again until then, as a queue of one message keeps only the newest."""
        for cause, publish in items:
            self.wait_for_count(name, key + ': ' + cause, self.count(name, key + ': ' + cause), publish)


def ball(center, radius, velocity=(0.0, 0.0, 0.0)):
    """Obstacle tracks with one ball that is at `center` now."""
    track = ObstacleTrack(id=1)
    for axis, p, v in zip('xyz', center, velocity):
        setattr(track.center, axis, p)
        setattr(track.velocity, axis, v)
        setattr(track.radii, axis, radius)
        setattr(track.exponents, axis, 2.0)
    track.orientation.w = 1.0
    message = ObstacleTrackArray(tracks=[track])
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = 'map'
    return message


def odometry(stamp, position, velocity=(0, 0, 0), yaw=0.0, frame='map'):
    """An odometry message; `velocity` is written into the twist as it is."""
    message = Odometry()
    message.header.stamp = stamp
    message.header.frame_id = frame
    message.child_frame_id = 'base_link'
    pose = message.pose.pose
    pose.position.x, pose.position.y, pose.position.z = position
    pose.orientation.z = math.sin(0.5 * yaw)
    pose.orientation.w = math.cos(0.5 * yaw)
    linear = message.twist.twist.linear
    linear.x, linear.y, linear.z = velocity
    return message


def publish_static_frame(frame, position, yaw, parent='map'):
    """Publishes a frame that stands still; keep the publisher that is returned."""
    transform = TransformStamped()
    transform.header.frame_id = parent
    transform.child_frame_id = frame
    translation = transform.transform.translation
    translation.x, translation.y, translation.z = position
    transform.transform.rotation.z = math.sin(0.5 * yaw)
    transform.transform.rotation.w = math.cos(0.5 * yaw)
    publisher = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
    publisher.publish(TFMessage([transform]))
    return publisher


def sample(trajectory, stamp):
    """Position and velocity of a trajectory message at a time, linear between its points."""
    t = (stamp - trajectory.header.stamp).to_sec()
    points = trajectory.points
    times = [point.time_from_start.to_sec() for point in points]
    after = next((i for i, each in enumerate(times) if each > t), len(points))
    if after in (0, len(points)):
        point = points[0 if after == 0 else -1]
        share, other = 0.0, point
    else:
        point, other = points[after - 1], points[after]
        share = (t - times[after - 1]) / (times[after] - times[after - 1])

    def mix(a, b):
        return tuple((1.0 - share) * getattr(a, axis) + share * getattr(b, axis) for axis in 'xyz')

    return (mix(point.transforms[0].translation, other.transforms[0].translation),
            mix(point.velocities[0].linear, other.velocities[0].linear))


class Vehicle:
    """A UAV that is always exactly where its trajectory wants it, at rest at its start before. `spoil` may change
    the odometry message before it is sent, or return None to keep it back."""

    def __init__(self, name, start):
        self.name = name
        self.start = start
        self.spoil = lambda message: message
        self.trajectories = Recorder(name + '/command/trajectory', MultiDOFJointTrajectory)
        self._publisher = rospy.Publisher(name + '/odometry', Odometry, queue_size=1, tcp_nodelay=True)

    def state(self, stamp):
        """The newest trajectory that has taken over by `stamp`, there."""
        active = [each for each in self.trajectories.all()[-10:] if each.header.stamp <= stamp]
        return sample(active[-1], stamp) if active else (self.start, (0.0, 0.0, 0.0))

    def publish(self, stamp):
        message = self.spoil(odometry(stamp, *self.state(stamp)))
        if message is None:
            return
        try:
            self._publisher.publish(message)
        except rospy.ROSException:
            pass  # the node shuts down


class Fleet:
    """Vehicles that publish odometry at 50 Hz of wall time until closed."""

    def __init__(self, vehicles):
        self.vehicles = vehicles
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        while not self._closed.wait(0.02) and not rospy.is_shutdown():
            now = rospy.Time.now()
            for vehicle in self.vehicles:
                vehicle.publish(now)

    def close(self):
        self._closed.set()
        self._thread.join()


class TestClock:
    """ROS time, with odometry of every vehicle at each step."""

    def __init__(self, vehicles, begin, step, speed):
        """Time does not go on before `runs` is set."""
        self.vehicles = vehicles
        self.now = begin  # [s]; may be set to let time jump
        self.step = step  # [s]
        self.speed = speed  # simulated over wall time
        self.runs = threading.Event()
        self.second = threading.Event()  # while it is set: another clock, a minute behind, goes on in turn with this one
        self._publisher = rospy.Publisher('/clock', Clock, queue_size=1)
        threading.Thread(target=self._run, daemon=True).start()

    def _wait(self):
        time.sleep(self.step / self.speed)

    def _run(self):
        while not rospy.is_shutdown():
            self._wait()
            if self.second.is_set():
                self._publisher.publish(Clock(clock=rospy.Time.from_sec(self.now - 60.0)))
                self._wait()
            if not self.runs.is_set():
                continue
            self.now += self.step
            stamp = rospy.Time.from_sec(self.now)
            self._publisher.publish(Clock(clock=stamp))
            for vehicle in self.vehicles:
                vehicle.publish(stamp)


def three_in_line():
    """The vehicles of scenarios/three_in_line.yaml."""
    return [Vehicle('uav%d' % (i + 1), (0.0, 10.0 * i, 20.0)) for i in range(3)]
