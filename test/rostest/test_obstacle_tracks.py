#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: one bad track that hides the good ones, an obstacle that is avoided long after it has gone, or
a warning that does not name the culprit."""

import math
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from swarm_harness import Fleet, Planner, Recorder, three_in_line, wait_for
from swarm_planner.msg import ObstacleTrack, ObstacleTrackArray


def track(track_id, center, radius=2.0, exponent=2.0):
    message = ObstacleTrack()
    message.id = track_id
    message.center.x, message.center.y, message.center.z = center
    for axis in 'xyz':
        setattr(message.radii, axis, radius)
        setattr(message.exponents, axis, exponent)
    message.orientation.w = 1.0
    return message


class ObstacleTracksTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_obstacle_tracks')
        cls.planner = Planner()
        cls.diagnostics = Recorder('/diagnostics', DiagnosticArray)
        cls.publisher = rospy.Publisher('obstacle_tracks', ObstacleTrackArray, queue_size=1)
        cls.vehicles = three_in_line()
        cls.fleet = Fleet(cls.vehicles)
        cls.planner.wait_for_start()

    def publish(self, tracks, frame='map'):
        message = ObstacleTrackArray()
        message.header.stamp = rospy.Time.now()
        message.header.frame_id = frame
        message.tracks = tracks
        self.publisher.publish(message)

    def ahead_of_uav1(self):
        """A place that uav1 gets near to within its horizon, beside its reference."""
        position, _ = self.vehicles[0].state(rospy.Time.now())
        return (position[0] + 8.0, -6.0, 20.0)

    def seen_while_publishing(self, tracks):
        def seen():
            self.publish(tracks())
            return math.isfinite(self.planner.uav('uav1').obstacle_clearance)
        wait_for(seen, 'a clearance to the obstacle')

    def test_good_track_counts_beside_bad_ones(self):
        self.seen_while_publishing(lambda: [
            track(10, self.ahead_of_uav1(), radius=0.0), track(11, self.ahead_of_uav1(), exponent=1.5),
            track(12, (float('nan'), 0.0, 0.0)), track(1, self.ahead_of_uav1()), track(1, (0.0, 0.0, 20.0))])
        uav = self.planner.uav('uav1')
        # The good one keeps off; the second of the same id would sit on the UAV's start.
        self.assertGreater(uav.obstacle_clearance, 0.0)

    def test_operator_is_told_which_track_is_bad(self):
        for bad, part in ((track(10, (50, 0, 20), radius=0.0), 'obstacle track 10 dropped: its radii'),
                          (track(11, (50, 0, 20), exponent=1.5), 'obstacle track 11 dropped: its exponents')):
            def told():
                self.publish([bad])
                messages = [status.message for array in self.diagnostics.all()[-5:] for status in array.status]
                return any(part in message for message in messages)
            wait_for(told, part)

    def test_track_is_forgotten_when_it_is_not_seen_any_more(self):
        self.seen_while_publishing(lambda: [track(1, self.ahead_of_uav1())])
        self.planner.wait_for_uav('uav1', lambda uav: math.isinf(uav.obstacle_clearance), 'a forgotten obstacle')

    def test_tracks_of_an_unknown_frame_are_not_used(self):
        self.planner.wait_for_uav('uav1', lambda uav: math.isinf(uav.obstacle_clearance), 'a free sky')
        for _ in range(20):
            self.publish([track(1, self.ahead_of_uav1())], frame='nowhere')
            self.planner.status.wait_for_more(1)
            self.assertTrue(math.isinf(self.planner.uav('uav1').obstacle_clearance))


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'obstacle_tracks', ObstacleTracksTest)
