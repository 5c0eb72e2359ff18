# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""What the tests of bad input share: messages of given bytes, counts from /diagnostics, the console, a node's memory."""

import os
import struct
import subprocess
import xmlrpc.client

import rosgraph
import rospy
from catkin.find_in_workspaces import find_in_workspaces
from rosgraph_msgs.msg import Log
from swarm_harness import Recorder, wait_for

TEN_MEGABYTES = 'x' * 10000000
# What a node may write at once: bad input names every bad thing in a bounded sentence, a few of them per message.
MOST_CONSOLE_TEXT = 3000


class Console:
    """What nodes write."""

    def __init__(self):
        self._recorder = Recorder('/rosout_agg', Log)

    def longest(self, node):
        return max([len(log.msg) for log in self._recorder.all() if log.name == node] or [0])

    def count(self, node):
        return len([log for log in self._recorder.all() if log.name == node])


class RawBytes:
    """Publishes bytes as if they were a message of a type."""

    def __init__(self, topic, message_type):
        self._type = type('Raw', (message_type,), {'serialize': lambda message, buffer: buffer.write(message.raw),
                                                   '__slots__': message_type.__slots__ + ['raw']})
        self._publisher = rospy.Publisher(topic, self._type, queue_size=3)

    def publish(self, raw):
        message = self._type()
        message.raw = raw
        self._publisher.publish(message)

    def wait_for_subscriber(self, count=1):
        wait_for(lambda: self._publisher.get_num_connections() >= count, 'a subscriber')


def track_array(centers, stamp, frame=b'map'):
    """The bytes of an ObstacleTrackArray with a sphere of radius 1 m at each centre."""
    body = struct.pack('<13d', 1, 1, 1, 2, 2, 2, 0, 0, 0, 1, 0, 0, 0) + struct.pack('<2d', 0, 0)
    header = struct.pack('<IIII', 0, stamp.secs, stamp.nsecs, len(frame)) + frame + struct.pack('<I', len(centers))
    return header + b''.join(struct.pack('<i3d', i, *center) + body for i, center in enumerate(centers))


def process_of(node):
    """Process id of a node."""
    uri = rosgraph.Master('/bad_input').lookupNode(node)
    return xmlrpc.client.ServerProxy(uri).getPid('/bad_input')[2]


def memory_of(pid):
    """Resident memory [MB]."""
    with open('/proc/%d/statm' % pid) as file:
        return int(file.read().split()[1]) * os.sysconf('SC_PAGE_SIZE') / 1e6


def processor_time_of(pid):
    """[s], in user and kernel mode."""
    with open('/proc/%d/stat' % pid) as file:
        fields = file.read().rsplit(')', 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def flood(seconds, rate, topics):
    """Publishes bad messages on each topic; returns the rate that was reached [Hz]."""
    # rosrun would look through the source tree too, which may hold programs of other builds.
    folders = find_in_workspaces(['libexec'], 'swarm_planner')
    program = next(os.path.join(folder, 'flood') for folder in folders
                   if os.path.exists(os.path.join(folder, 'flood')))
    command = [program, str(seconds), str(rate)] + list(topics)
    return float(subprocess.run(command, stdout=subprocess.PIPE, check=True, timeout=120).stdout)
