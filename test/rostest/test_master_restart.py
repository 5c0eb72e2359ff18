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
from std_msgs.msg import Empty
from std_srvs.srv import Trigger
from swarm_harness import Planner, Recorder, wait_for
from swarm_planner.msg import UavStatus
from trajectory_msgs.msg import MultiDOFJointTrajectory


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
        begin = self.odometry.newest().pose.pose.position.x
        misses = self.planner.status.last().deadline_misses
        count = self.planner.status.count()
        time.sleep(seconds)
        self.assertGreater(self.planner.status.count(), count + seconds / 0.3 - 4)
        self.assertLessEqual(self.planner.status.last().deadline_misses, misses + 1)
        for uav in self.planner.status.last().uavs:
            self.assertEqual(uav.state, UavStatus.TRACKING)
        self.assertGreater(self.odometry.newest().pose.pose.position.x, begin + 1.0)

    def registered(self):
        """Names of what the master knows: topics that are published, topics that the planner reads, services."""
        published, subscribed, services = rosgraph.Master('/test').getSystemState()
        planner = rospy.resolve_name('planner_node')
        return ({topic for topic, _ in published}, {topic for topic, nodes in subscribed if planner in nodes},
                {name for name, _ in services})

    def test_flight_goes_on_and_nodes_come_back(self):
        control = rospy.Publisher('control', Empty, queue_size=1)
        self.planner.wait_for_start()
        self.planner.wait_for_uav('uav1', lambda uav: uav.state == UavStatus.TRACKING, 'tracking')
        time.sleep(2.0)
        before = self.registered()
        self.assertIn(control.resolved_name, before[0])
        self.assertIn(rospy.resolve_name('uav1/odometry'), before[1])
        self.assertIn(rospy.resolve_name('planner_node/hold'), before[2])
        self.master.kill()
        self.master.wait()
        self.check_flight(4.0)
        self.start_master()
        self.check_flight(4.0)

        def others(names):
            return {name for name in names if name != control.resolved_name and rospy.get_name() not in name}
        wait_for(lambda: not any(others(old) - new for old, new in zip(before, self.registered())),
                 'nodes that register again')
        # The negative control: this node has no MasterWatch, and ROS 1 does not do it.
        self.assertNotIn(control.resolved_name, self.registered()[0])
        # Who comes later finds topics and services; who was connected before is still.
        Recorder('uav2/command/trajectory', MultiDOFJointTrajectory).wait_for_more(3)
        rospy.wait_for_service('planner_node/hold', timeout=20)
        answer = rospy.ServiceProxy('planner_node/hold', Trigger)()
        self.assertTrue(answer.success, answer.message)
        self.planner.wait_for_uav('uav1', lambda uav: uav.state == UavStatus.HOLDING, 'holding')


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'master_restart', MasterRestartTest)
