#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a simulation whose messages are not as late as its parameters say, or a swarm that late messages
keep on the ground.

Private parameter: latency [s]."""

import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry
from swarm_harness import Planner, Recorder, wait_for
from swarm_planner.msg import ObstacleTrackArray, UavStatus


class LateMessagesTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_late_messages')
        cls.latency = rospy.get_param('~latency')
        cls.planner = Planner()
        cls.odometry = Recorder('uav1/odometry', Odometry)
        cls.tracks = Recorder('obstacle_tracks', ObstacleTrackArray)

    def assert_late(self, recorder):
        recorder.wait_for_more(20)
        ages = [(arrival - message.header.stamp).to_sec()
                for message, arrival in zip(recorder.all(), recorder.arrivals)]
        self.assertGreater(min(ages), self.latency - 0.02)
        self.assertLess(sorted(ages)[len(ages) // 2], self.latency + 0.1)

    def test_1_odometry_is_late(self):
        self.assert_late(self.odometry)

    def test_2_tracks_are_late(self):
        self.assert_late(self.tracks)

    def test_3_the_swarm_flies_all_the_same(self):
        self.planner.wait_for_start()
        self.planner.wait_for_uav('uav1', lambda uav: uav.state == UavStatus.TRACKING, 'tracking')
        wait_for(lambda: self.odometry.newest().pose.pose.position.x > 2.0, 'a flight of 2 m')


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'late_messages', LateMessagesTest)
