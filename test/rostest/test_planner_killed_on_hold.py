#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a swarm that was told to stay, and flies off because its planner was started again."""

import math
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger
from swarm_harness import Planner, Recorder, kill_node, wait_for


class PlannerKilledOnHoldTest(unittest.TestCase):

    def speed(self):
        linear = self.odometry.newest().twist.twist.linear
        return math.hypot(linear.x, linear.y, linear.z)

    def call(self, name):
        rospy.wait_for_service('planner_node/' + name, timeout=40)
        return rospy.ServiceProxy('planner_node/' + name, Trigger)()

    def restart(self):
        kill_node('planner_node')
        rospy.sleep(0.5)
        self.planner.status.clear()
        wait_for(lambda: self.planner.status.count() > 5, 'another planner')

    def test_stays_until_it_is_started(self):
        rospy.init_node('test_planner_killed_on_hold')
        self.planner = Planner()
        self.odometry = Recorder('uav1/odometry', Odometry)
        self.planner.wait_for_start()
        wait_for(lambda: self.speed() > 1.0, 'a flight')
        self.restart()
        rospy.sleep(3.0)
        self.assertGreater(self.speed(), 1.0, 'the negative control: without a command it flies on')
        self.assertTrue(self.call('hold').success)
        wait_for(lambda: self.speed() < 0.1, 'a swarm at rest')
        self.restart()
        place = self.odometry.newest().pose.pose.position
        rospy.sleep(8.0)
        now = self.odometry.newest().pose.pose.position
        self.assertLess(math.dist((place.x, place.y, place.z), (now.x, now.y, now.z)), 0.3)
        self.assertTrue(self.call('start').success)
        wait_for(lambda: self.speed() > 1.0, 'a flight that goes on')
        self.assertGreater(self.planner.uav('uav1').target.x, now.x - 2.0, 'it flies back')


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'planner_killed_on_hold', PlannerKilledOnHoldTest)
