#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a planner that dies, falls silent or sends setpoints of another time when ROS time jumps back
(a bag that loops, a simulation that is reset)."""

import threading
import time
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Clock
from swarm_harness import Planner, three_in_line, wait_for

STEP = 0.02
SPEED = 2.0


class TimeJumpTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_time_jump')
        cls.planner = Planner()
        cls.vehicles = three_in_line()
        cls.clock = rospy.Publisher('/clock', Clock, queue_size=1)
        cls.now = 500.0
        threading.Thread(target=cls.run_clock, daemon=True).start()

    @classmethod
    def run_clock(cls):
        while not rospy.is_shutdown():
            cls.now += STEP
            stamp = rospy.Time.from_sec(cls.now)
            cls.clock.publish(Clock(clock=stamp))
            for vehicle in cls.vehicles:
                vehicle.publish(stamp)
            time.sleep(STEP / SPEED)

    def test_run_starts_anew_after_a_jump_back(self):
        before = self.planner.wait_for_start()
        self.assertGreater(before.time_zero.to_sec(), 500.0)
        wait_for(lambda: all(vehicle.trajectories.count() > 5 for vehicle in self.vehicles), 'a few plans')

        type(self).now = 20.0
        jumped = rospy.Time.from_sec(400.0)
        after = wait_for(lambda: next((status for status in self.planner.status.all()
                                       if status.started and status.header.stamp < jumped), None), 'a new start')
        self.assertGreater(after.time_zero.to_sec(), 20.0)
        self.assertLess(after.time_zero.to_sec(), 400.0)
        for vehicle in self.vehicles:
            vehicle.trajectories.clear()
            for trajectory in vehicle.trajectories.wait_for_more(5):
                self.assertLess(trajectory.header.stamp, jumped)
        # Of the first plans: these vehicles stand still whatever they are sent, so later ones find them astray.
        for uav in after.uavs:
            self.assertTrue(uav.planned)
            self.assertEqual(uav.reason, '')


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'time_jump', TimeJumpTest)
