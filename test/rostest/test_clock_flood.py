#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a planner that is late, starts anew or stops because a node publishes /clock far too often."""

import time
import unittest

import rospy
import rostest
from bad_input_harness import flood
from swarm_harness import Planner
from swarm_planner.msg import UavStatus

SECONDS = 4.0


class ClockFloodTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        # Python could not read so many messages: this node lives in wall time.
        rospy.init_node('test_clock_flood', disable_rostime=True)
        cls.planner = Planner()
        cls.planner.wait_for_start()
        cls.planner.wait_for_uav('uav1', lambda uav: uav.state == UavStatus.TRACKING, 'tracking')

    def cycles_while(self, action):
        self.planner.status.clear()
        result = action()
        statuses = self.planner.status.all()
        self.assertGreater(len(statuses), 3)
        return statuses, result

    def test_flown_on_as_if_nothing_were(self):
        quiet, _ = self.cycles_while(lambda: time.sleep(SECONDS))
        flooded, rate = self.cycles_while(lambda: flood(SECONDS, 10000, ['/clock']))
        self.assertGreater(rate, 1000.0)
        self.assertGreater(len(flooded), 0.7 * len(quiet))
        self.assertEqual({status.time_zero for status in flooded}, {quiet[0].time_zero}, 'the run has started anew')
        for status in flooded:
            for uav in status.uavs:
                self.assertNotEqual(uav.state, UavStatus.LOST, uav.reason)
        misses = [sum(status.deadline_missed for status in statuses) for statuses in (quiet, flooded)]
        # Where the whole machine is late it is late without the flood, too; two more are a hiccup.
        self.assertLessEqual(misses[1], 2 * misses[0] + 2)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'clock_flood', ClockFloodTest)
