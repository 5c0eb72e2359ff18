#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a swarm that stands still, or whose operator is told nothing, when a tracker falls silent or the
source of odometry is started again."""

import math
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import Odometry
from swarm_harness import Planner, Recorder, kill_node, wait_for
from swarm_planner.msg import ObstacleTrack, ObstacleTrackArray, UavStatus

TRACK_TIMEOUT = 1.0  # [s]


class SourcesGoneTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_sources_gone')
        cls.planner = Planner()
        cls.diagnostics = Recorder('/diagnostics', DiagnosticArray)
        cls.publisher = rospy.Publisher('obstacle_tracks', ObstacleTrackArray, queue_size=1)
        cls.planner.wait_for_start()

    def send_track(self):
        """A ball 10 m from uav1."""
        track = ObstacleTrack(id=1)
        track.center.x, track.center.z = 12.0, 30.0
        for axis in 'xyz':
            setattr(track.radii, axis, 2.0)
            setattr(track.exponents, axis, 2.0)
        track.orientation.w = 1.0
        message = ObstacleTrackArray(tracks=[track])
        message.header.stamp = rospy.Time.now()
        message.header.frame_id = 'map'
        self.publisher.publish(message)

    def health(self, entry):
        return next(((each.level, each.message) for array in reversed(self.diagnostics.all())
                     for each in array.status if each.name.endswith(': ' + entry)), (None, ''))

    def test_tracker_falls_silent(self):
        def knows():
            self.send_track()
            return math.isfinite(self.planner.uav('uav1').obstacle_clearance)

        def is_told():
            self.send_track()
            return self.health('obstacle tracks')[0] == DiagnosticStatus.OK and '1 obst' in self.health(
                'obstacle tracks')[1]
        wait_for(knows, 'an obstacle in the plans')
        wait_for(is_told, 'diagnostics that count it')
        silent = rospy.Time.now().to_sec()
        wait_for(lambda: not math.isfinite(self.planner.uav('uav1').obstacle_clearance), 'an obstacle forgotten')
        last = max(status.header.stamp.to_sec() for status in self.planner.status.all()
                   for uav in status.uavs if uav.name == 'uav1' and math.isfinite(uav.obstacle_clearance))
        self.assertGreater(last, silent + 0.5 * TRACK_TIMEOUT, 'it was forgotten at once')
        self.assertLess(last, silent + TRACK_TIMEOUT + 0.5)
        wait_for(lambda: self.health('obstacle tracks')[0] == DiagnosticStatus.WARN and
                 'forgotten' in self.health('obstacle tracks')[1], 'a warning')
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
