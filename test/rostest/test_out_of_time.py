#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: vehicles that run out of setpoints because planning takes too long, or an operator who is not
told that it does."""

import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from swarm_harness import Diagnostics, Planner, TestClock, three_in_line, wait_for
from swarm_planner.msg import UavStatus

NO_TIME = 'no time left to plan; the last plan goes on'


class OutOfTimeTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_out_of_time')
        cls.planner = Planner()
        cls.diagnostics = Diagnostics()
        cls.vehicles = three_in_line()
        cls.clock = TestClock(cls.vehicles, begin=500.0, step=0.02, speed=1.0)
        cls.clock.runs.set()

    def wait_until_all_have_tracked(self):
        """Each at some time: who misses its turn comes first in the next cycle."""
        self.planner.status.clear()
        wait_for(lambda: {uav.name for status in self.planner.status.all() for uav in status.uavs
                          if uav.state == UavStatus.TRACKING and uav.planned} == {'uav1', 'uav2', 'uav3'},
                 'a plan for every UAV')

    def out_of_time(self):
        return [status for status in self.planner.status.all()
                if status.out_of_time and any(uav.reason == NO_TIME for uav in status.uavs)]

    def test_motions_go_on(self):
        self.planner.wait_for_start()
        self.wait_until_all_have_tracked()

        # Of simulated time, in which planning may take 0.6 ms of each cycle: enough for at least one UAV.
        self.clock.step = 0.1
        self.clock.speed = 40.0
        self.planner.status.clear()
        wait_for(lambda: len(self.out_of_time()) > 20, 'cycles without time to plan')
        for vehicle in self.vehicles:
            vehicle.trajectories.wait_for_more(5)
        plans = {message.cycle: {plan.name for plan in message.plans} for message in self.planner.plans.all()}
        compared = 0
        for status in self.out_of_time():
            late = [uav for uav in status.uavs if uav.reason == NO_TIME]
            self.assertTrue(all(uav.state == UavStatus.FALLBACK and uav.planned for uav in late), status)
            self.assertFalse(any(uav.alarm for uav in status.uavs), status)
            if status.cycle in plans:
                compared += 1
                self.assertLessEqual({uav.name for uav in late}, plans[status.cycle])
        self.assertGreater(compared, 0)
        wait_for(lambda: any('had no time to plan for every UAV' in message and level == DiagnosticStatus.WARN
                             for level, message in self.diagnostics.told('planning cycle')), 'a warning')

        self.clock.step = 0.02
        self.clock.speed = 1.0
        self.wait_until_all_have_tracked()


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'out_of_time', OutOfTimeTest)
