#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a swarm that stops, or is no longer told of, because the ROS master has died. The test has a
master of its own to kill; nodes and test are connected through that one."""

import os
import signal
import socket
import subprocess
import time
import unittest

import rosgraph
import rospkg
import rospy
import rostest
from nav_msgs.msg import Odometry
from swarm_harness import Planner, Recorder, wait_for
from swarm_planner.msg import UavStatus


def free_port():
    with socket.socket() as listener:
        listener.bind(('', 0))
        return listener.getsockname()[1]


class MasterRestartTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.port = free_port()
        os.environ['ROS_MASTER_URI'] = 'http://localhost:%d' % cls.port
        cls.start_master()
        folder = os.path.join(rospkg.RosPack().get_path('swarm_planner'), 'test', 'rostest')
        cls.launch = subprocess.Popen(['roslaunch', os.path.join(folder, 'swarm.launch'), 'speed:=1',
                                       'scenario:=' + os.path.join(folder, 'scenarios', 'weave.yaml')])
        rospy.init_node('test_master_restart')
        cls.planner = Planner()
        cls.odometry = Recorder('uav1/odometry', Odometry)

    @classmethod
    def tearDownClass(cls):
        cls.launch.send_signal(signal.SIGINT)
        cls.launch.wait(timeout=30)
        cls.master.kill()

    @classmethod
    def start_master(cls):
        cls.master = subprocess.Popen(['rosmaster', '--core', '-p', str(cls.port)], stdout=subprocess.DEVNULL)
        wait_for(lambda: rosgraph.is_master_online(), 'a master')

    def check_flight(self, seconds):
        """All goes on over the connections that there are."""
        begin = self.odometry.last().pose.pose.position.x
        misses = self.planner.status.last().deadline_misses
        count = self.planner.status.count()
        time.sleep(seconds)
        self.assertGreater(self.planner.status.count(), count + seconds / 0.3 - 4)
        self.assertLessEqual(self.planner.status.last().deadline_misses, misses + 1)
        for uav in self.planner.status.last().uavs:
            self.assertEqual(uav.state, UavStatus.TRACKING)
        self.assertGreater(self.odometry.last().pose.pose.position.x, begin + 1.0)

    def published(self):
        return [topic for topic, _ in rosgraph.Master('/test').getPublishedTopics('')]

    def test_flight_goes_on(self):
        self.planner.wait_for_start()
        self.planner.wait_for_uav('uav1', lambda uav: uav.state == UavStatus.TRACKING, 'tracking')
        time.sleep(2.0)
        status = rospy.resolve_name('planner_node/status')
        self.assertIn(status, self.published())
        self.master.kill()
        self.master.wait()
        self.check_flight(4.0)
        self.start_master()
        self.check_flight(4.0)
        # As ROS 1 has it: nodes do not come back to a new master, so that new nodes do not find them.
        self.assertNotIn(status, self.published())


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'master_restart', MasterRestartTest)
