#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a swarm that stands still, or whose operator is told nothing, when a tracker falls silent or the
source of odometry is started again."""

import math
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus
from nav_msgs.msg import Odometry
from swarm_harness import Diagnostics, Planner, Recorder, ball, kill_node, wait_for
from swarm_planner.msg import ObstacleTrackArray, UavStatus

TRACK_TIMEOUT = 1.0  # [s]


class SourcesGoneTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_sources_gone')
        cls.planner = Planner()
        cls.diagnostics = Diagnostics()
        cls.publisher = rospy.Publisher('obstacle_tracks', ObstacleTrackArray, queue_size=1)
        cls.planner.wait_for_start()

    def send_track(self):
        """A ball 10 m from uav1."""
        self.publisher.publish(ball((12.0, 0.0, 30.0), 2.0))

    def test_tracker_falls_silent(self):
        def knows():
            self.send_track()
            return math.isfinite(self.planner.uav('uav1').obstacle_clearance)

        def is_told():
            self.send_track()
            entry = self.diagnostics.entry('obstacle tracks')
            return entry and entry.level == DiagnosticStatus.OK and '1 obst' in entry.message
        wait_for(knows, 'an obstacle in the plans')
        wait_for(is_told, 'diagnostics that count it')
        silent = rospy.Time.now().to_sec()
        wait_for(lambda: not math.isfinite(self.planner.uav('uav1').obstacle_clearance), 'an obstacle forgotten')
        last = max(status.header.stamp.to_sec() for status in self.planner.status.all()
                   for uav in status.uavs if uav.name == 'uav1' and math.isfinite(uav.obstacle_clearance))
        self.assertGreater(last, silent + 0.5 * TRACK_TIMEOUT, 'it was forgotten at once')
        self.assertLess(last, silent + TRACK_TIMEOUT + 0.5)
        self.diagnostics.wait_for('obstacle tracks', DiagnosticStatus.WARN, 'forgotten')
        self.planner.wait_for_uav('uav1', lambda uav: uav.state == UavStatus.TRACKING, 'a flight that goes on')
        # The negative control: there is a tracker again, and no warning.
        wait_for(is_told, 'diagnostics that are content')

    def test_source_of_odometry_is_started_again(self):
        odometry = Recorder('uav1/odometry', Odometry)
        odometry.wait_for_more(5)
        self.planner.status.clear()
        kill_node('quad_sim_node')
        lost = wait_for(lambda: next((uav for status in self.planner.status.all() for uav in status.uavs
                                      if uav.state == UavStatus.LOST), None), 'UAVs lost')
        self.assertIn('odometry is too old', lost.reason)
        count = odometry.count()
        wait_for(lambda: odometry.count() > count, 'odometry again')
        for name in ('uav1', 'uav2'):
            self.planner.wait_for_uav(name, lambda uav: uav.state == UavStatus.TRACKING and not uav.reason, 'tracking')


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'sources_gone', SourcesGoneTest)
