#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a UAV that is in danger while status and diagnostics show nothing, an alarm for those that are
not, or one that stays when the danger has gone."""

import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from swarm_harness import Diagnostics, Planner, ball, wait_for
from swarm_planner.msg import ObstacleTrackArray, UavStatus

# Where uav1 of scenarios/hovering.yaml hovers [m].
HOME = (0.0, 0.0, 30.0)


class SuddenObstaclesTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_sudden_obstacles')
        cls.planner = Planner()
        cls.diagnostics = Diagnostics()
        cls.publisher = rospy.Publisher('obstacle_tracks', ObstacleTrackArray, queue_size=1)
        cls.planner.wait_for_start()

    def setUp(self):
        self.wait_for_calm()
        self.planner.status.clear()
        self.diagnostics.clear()

    def wait_for_calm(self):
        """Both UAVs track, and diagnostics say so."""
        for name in ('uav1', 'uav2'):
            self.planner.wait_for_uav(name, lambda uav: uav.state == UavStatus.TRACKING and not uav.reason,
                                      'tracking')
        wait_for(lambda: {level for name in ('uav1', 'uav2') for level, _ in self.diagnostics.told(name)[-1:]} ==
                 {DiagnosticStatus.OK}, 'diagnostics without a complaint')

    def send(self, center, velocity, radius):
        self.publisher.publish(ball(center, radius, velocity))

    def check_alarm(self, send):
        """Calls `send` until there is an alarm for uav1, then until the operator has been told of it."""
        rejected = self.planner.status.wait_for_more(1)[-1].rejected_plans

        def alarmed():
            send()
            return next((uav for status in self.planner.status.all() for uav in status.uavs if uav.alarm), None)
        uav = wait_for(alarmed, 'an alarm')
        self.assertEqual(uav.name, 'uav1')
        self.assertEqual(uav.state, UavStatus.FALLBACK)
        self.assertTrue(uav.planned, 'it has to fly something')
        self.assertTrue(uav.refusal)
        self.assertIn('(%s)' % uav.refusal, uav.reason)

        def told():
            send()
            return [message for level, message in self.diagnostics.told('uav1') if level == DiagnosticStatus.ERROR]
        self.assertIn('no plan keeps all distances', wait_for(told, 'an error in the diagnostics')[0])
        self.assertGreater(self.planner.status.last().rejected_plans, rejected)

    def check_calm_afterwards(self):
        # The obstacle is forgotten track_timeout after it was seen last.
        self.wait_for_calm()
        self.assertTrue(all(not uav.alarm for status in self.planner.status.all() for uav in status.uavs
                            if uav.name == 'uav2'), 'no danger for uav2')
        self.assertEqual({level for level, _ in self.diagnostics.told('uav2')}, {DiagnosticStatus.OK})

    def test_alarm_for_an_obstacle_that_appears_on_top_of_a_uav(self):
        self.check_alarm(lambda: self.send(HOME, (0.0, 0.0, 0.0), 2.0))
        self.check_calm_afterwards()

    def test_alarm_for_an_obstacle_that_comes_too_fast(self):
        begin = rospy.Time.now()

        def send():
            elapsed = (rospy.Time.now() - begin).to_sec()
            self.send((60.0 - 40.0 * elapsed, 0.0, 30.0), (-40.0, 0.0, 0.0), 12.0)
        self.check_alarm(send)
        self.check_calm_afterwards()


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'sudden_obstacles', SuddenObstaclesTest)
