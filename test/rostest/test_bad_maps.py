#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: a map that ends the planner, fills its memory, goes unnoticed, or takes the last good one away; or
one that octomap_server or a driver sends and that is not taken."""

import struct
import unittest

import rospy
import rostest
from bad_input_harness import MOST_CONSOLE_TEXT, Console, RawBytes, memory_of, process_of
from diagnostic_msgs.msg import DiagnosticStatus
from map_harness import Octomap, box, cloud, octomap, octree
from sensor_msgs.msg import PointCloud2
from swarm_harness import Diagnostics, Fleet, Planner, publish_static_frame, three_in_line, wait_for
from swarm_planner.msg import UavStatus

MAP = 'planner_node: map'
DROPPED = 'maps or clouds dropped'
NAN = float('nan')
BLOCK = box((300, 0, 0), (310, 10, 10))
GOOD, WHOLE = octree(BLOCK), octree(BLOCK, binary=False)
VOXELS = len(BLOCK)


class BadMapsTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_bad_maps')
        cls.planner = Planner()
        cls.diagnostics = Diagnostics()
        cls.console = Console()
        cls.binary = rospy.Publisher('octomap_binary', Octomap, queue_size=5)
        cls.full = rospy.Publisher('octomap_full', Octomap, queue_size=5)
        cls.clouds = rospy.Publisher('map_cloud', PointCloud2, queue_size=5)
        cls.raw_maps = RawBytes('octomap_binary', Octomap)
        cls.raw_clouds = RawBytes('map_cloud', PointCloud2)
        cls.moved = publish_static_frame('moved', (1.0, 2.0, 3.0), 0.0)
        cls.vehicles = three_in_line()
        cls.fleet = Fleet(cls.vehicles)
        cls.planner.wait_for_start()
        for publisher in (cls.binary, cls.full, cls.clouds):
            wait_for(lambda: publisher.get_num_connections() > 0, 'the planner to take maps')
        cls.raw_maps.wait_for_subscriber()
        cls.raw_clouds.wait_for_subscriber()
        cls.pid = process_of('/planner_node')

    @classmethod
    def tearDownClass(cls):
        cls.fleet.close()

    def setUp(self):
        good = octomap(GOOD, 0.1)
        self.assert_taken(lambda: self.binary.publish(good), VOXELS)
        self.memory = memory_of(self.pid)

    def tearDown(self):
        """After whatever came the same process plans, every UAV tracks, memory and console are as before."""
        self.assertEqual(process_of('/planner_node'), self.pid)
        for vehicle in self.vehicles:
            self.planner.wait_for_uav(vehicle.name, lambda uav: uav.state == UavStatus.TRACKING, 'tracking')
        self.assertLess(memory_of(self.pid) - self.memory, 200.0)
        self.assertLess(self.console.longest('/planner_node'), MOST_CONSOLE_TEXT)

    def wait_for_voxels(self, count):
        return self.diagnostics.wait_for(MAP, DiagnosticStatus.OK, '%d occupied voxels' % count)

    def assert_taken(self, publish, count):
        """Published again until it is: the map before it, on another topic, may arrive after it."""
        def is_taken():
            publish()
            rospy.sleep(0.5)
            entry = self.diagnostics.entry(MAP)
            return entry.level == DiagnosticStatus.OK and '%d occupied voxels' % count in entry.message
        wait_for(is_taken, 'a map of %d voxels' % count)

    def assert_refused(self, reason, items):
        """Each is counted under the reason, with a warning; the last good map stays."""
        for text, publish in items:
            self.diagnostics.clear()
            count = self.diagnostics.count(MAP, DROPPED + ': ' + reason)
            publish()
            self.diagnostics.wait_for_count(MAP, DROPPED + ': ' + reason, count)
            wait_for(lambda: any(level == DiagnosticStatus.WARN and text in said
                                 for level, said in self.diagnostics.told(MAP)), 'a warning that says: ' + text)
            self.wait_for_voxels(VOXELS)

    def bodies(self):
        """A point on each UAV."""
        return [(x, y, z + 0.2) for x, y, z in (vehicle.state(rospy.Time.now())[0] for vehicle in self.vehicles)]

    def map_of(self, *arguments, **keys):
        return lambda: self.binary.publish(octomap(*arguments, **keys))

    def test_octrees_that_are_no_map(self):
        endless = b'\x03' * 200000
        self.assert_refused('no usable map', [
            ('cut off', self.map_of(GOOD[:-3], 0.1)),
            ('bytes follow', self.map_of(GOOD + b'\0\0', 0.1)),
            ('empty', self.map_of(b'', 0.1)),
            ('nothing in it is known', self.map_of(b'\0\0', 0.1)),
            ("type 'OcTreeStamped'", self.map_of(GOOD, 0.1, tree_type='OcTreeStamped')),
            ('resolution of 0 m', self.map_of(GOOD, 0.0)),
            ('resolution of nan m', self.map_of(GOOD, NAN)),
            ('resolution of 1e+09 m', self.map_of(GOOD, 1e9)),
            ('deeper than its voxels', self.map_of(endless, 0.1)),
            ('too large', self.map_of(b'\x02\0', 0.1)),
            ('cut off', lambda: self.full.publish(octomap(WHOLE[:-3], 0.1, binary=False))),
            ('no number', lambda: self.full.publish(octomap(struct.pack('<fB', NAN, 0), 0.1, binary=False))),
        ])

    def test_maps_in_unknown_frames(self):
        self.assert_refused('unknown frame', [
            ("no transform from 'mars'", self.map_of(GOOD, 0.1, frame='mars')),
            ('frame_id is empty', self.map_of(GOOD, 0.1, frame='')),
            ("no transform from 'mars'", lambda: self.clouds.publish(cloud([(1, 0, 20)], frame='mars'))),
        ])

    def test_messages_that_state_what_is_not_so(self):
        lying = struct.pack('<IIII', 0, 0, 0, 3) + b'map' + b'\1' + struct.pack('<I', 0xFFFFFFF0)
        self.assert_refused('malformed', [
            ('cannot be unpacked', lambda: self.raw_maps.publish(lying)),
            ('cannot be unpacked', lambda: self.raw_clouds.publish(lying)),
        ])
        misfit = cloud([(1, 0, 20)] * 10)
        misfit.width = 1000000
        nameless = cloud([(1, 0, 20)])
        nameless.fields = nameless.fields[:2]
        self.assert_refused('malformed', [
            ('sizes do not fit', lambda: self.clouds.publish(misfit)),
            ('without fields x, y and z', lambda: self.clouds.publish(nameless)),
        ])

    def test_clouds_without_a_point(self):
        self.assert_refused('not finite', [
            ('without any point', lambda: self.clouds.publish(cloud([(NAN, 0, 20), (1, NAN, 20)]))),
            ('without any point', lambda: self.clouds.publish(cloud([]))),
            ('without any point', lambda: self.clouds.publish(cloud(self.bodies()))),
        ])

    def test_full_maps_and_maps_in_other_frames_are_taken(self):
        full = octomap(octree(BLOCK[:400], binary=False), 0.1, binary=False)
        self.assert_taken(lambda: self.full.publish(full), 400)
        moved = octomap(octree(BLOCK[:300]), 0.1, frame='moved')
        self.assert_taken(lambda: self.binary.publish(moved), 300)

    def test_clouds_are_added_to_the_map(self):
        wall = [(8.05, 0.1 * y + 0.05, 0.55) for y in range(10)]
        seen = cloud(wall + [(NAN, 0, 0)])
        self.assert_taken(lambda: self.clouds.publish(seen), VOXELS + len(wall))


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'bad_maps', BadMapsTest)
