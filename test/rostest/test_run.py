#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a swarm that collides or falls behind when flown closed loop.

Private parameters: summary_file; expect: 'clear', or 'collision' for negative controls, which prove that the
simulation would see one; max_lag [m]; least_cycles."""

import os
import unittest

import rospy
import rostest
from swarm_harness import wait_for_summary


class RunTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_run')
        path = rospy.get_param('~summary_file')
        cls.summary = wait_for_summary(path, timeout=150.0)
        os.remove(path)

    def test_keeps_clear_or_is_seen_to_collide(self):
        expect = rospy.get_param('~expect')
        self.assertIn(expect, ('clear', 'collision'))
        if expect == 'clear':
            self.assertEqual(self.summary['collisions'], 0, self.summary)
            self.assertIs(self.summary['clear'], True)
        else:
            self.assertGreater(self.summary['collisions'], 0, self.summary)
            self.assertIs(self.summary['clear'], False)

    def test_follows_the_targets(self):
        self.assertLess(self.summary['final_lag_m']['max'], rospy.get_param('~max_lag', 10.0), self.summary)
        self.assertEqual(self.summary['stuck_uavs'], 0)

    def test_is_flown_as_planned(self):
        self.assertEqual(self.summary['ended_by'], 'scenario')
        self.assertGreater(self.summary['cycles'], rospy.get_param('~least_cycles'))
        self.assertLess(self.summary['tracking_error_m']['mean'], 0.3)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'run', RunTest)
