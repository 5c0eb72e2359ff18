#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Breaks for the user: one source gone mad, a wrong unit, an uninitialised message or a flood, that stops the swarm, fills
the memory or the console, or goes unnoticed. Good odometry comes all the time; UAVs have to go on tracking."""

import functools
import math
import struct
import unittest

import rospy
import rostest
from bad_input_harness import (MOST_CONSOLE_TEXT, TEN_MEGABYTES, Console, RawBytes, flood, memory_of,
                               process_of, processor_time_of, track_array)
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Point, TransformStamped
from nav_msgs.msg import Odometry
from swarm_harness import Diagnostics, Fleet, Planner, odometry, three_in_line, wait_for
from swarm_planner.msg import ObstacleTrackArray, UavStatus
from swarm_planner.srv import SetReference, SetReferenceRequest
from tf2_msgs.msg import TFMessage

UAV2 = 'planner_node: uav2'
TRACKS = 'planner_node: obstacle tracks'
TRANSFORMS = 'planner_node: transforms'
CYCLE = 'planner_node: planning cycle'
DROPPED = {UAV2: 'odometry dropped', TRACKS: 'tracks or messages dropped', TRANSFORMS: 'transforms or messages dropped'}


class BadInputTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        rospy.init_node('test_bad_input')
        cls.planner = Planner()
        cls.diagnostics = Diagnostics()
        cls.console = Console()
        cls.odometry = rospy.Publisher('uav2/odometry', Odometry, queue_size=5)
        cls.tracks = RawBytes('obstacle_tracks', ObstacleTrackArray)
        cls.transforms = rospy.Publisher('/tf', TFMessage, queue_size=5)
        rospy.wait_for_service('planner_node/set_reference', timeout=60)
        cls.set_reference = staticmethod(rospy.ServiceProxy('planner_node/set_reference', SetReference))
        cls.vehicles = three_in_line()
        cls.fleet = Fleet(cls.vehicles)
        cls.planner.wait_for_start()
        cls.tracks.wait_for_subscriber()
        cls.pid = process_of('/planner_node')
        wait_for(lambda: cls.diagnostics.entry(CYCLE), 'diagnostics')

    @classmethod
    def tearDownClass(cls):
        cls.fleet.close()

    def setUp(self):
        self.memory = memory_of(self.pid)
        self.wait_for_tracking()

    def tearDown(self):
        """After whatever came: the same process plans, every UAV tracks, memory and console are as before."""
        self.assertEqual(process_of('/planner_node'), self.pid)
        self.wait_for_tracking()
        for vehicle in self.vehicles:
            for trajectory in vehicle.trajectories.wait_for_more(2):
                for point in trajectory.points:
                    for vector in (point.transforms[0].translation, point.velocities[0].linear):
                        self.assertTrue(all(math.isfinite(each) for each in (vector.x, vector.y, vector.z)))
        self.assertLess(memory_of(self.pid) - self.memory, 300.0)
        self.assertLess(self.console.longest('/planner_node'), MOST_CONSOLE_TEXT)

    def wait_for_tracking(self):
        for vehicle in self.vehicles:
            self.planner.wait_for_uav(vehicle.name, lambda uav: uav.state == UavStatus.TRACKING, 'tracking')

    def lost_since(self, statuses):
        return [uav.name for status in statuses for uav in status.uavs if uav.state == UavStatus.LOST]

    def dropped(self, entry, reason):
        return self.diagnostics.count(entry, DROPPED[entry] + ': ' + reason)

    def assert_counted(self, entry, items):
        """Of each pair of a reason and a function that publishes, the message is counted; nobody is lost meanwhile."""
        self.planner.status.clear()
        self.diagnostics.wait_for_counts(entry, DROPPED[entry], items)
        self.assertEqual(self.lost_since(self.planner.status.all()), [])

    def good_odometry(self):
        now = rospy.Time.now()
        return odometry(now, *self.vehicles[1].state(now))

    def test_odometry(self):
        def position(value):
            return lambda message: setattr(message.pose.pose.position, 'x', value)

        def norm(value):
            return lambda message: (setattr(message.pose.pose.orientation, 'w', value),
                                    setattr(message.pose.pose.orientation, 'z', 0.0))

        def publish(spoil):
            message = self.good_odometry()
            spoil(message)
            self.odometry.publish(message)

        table = (('not finite', position(math.nan)),
                 ('too long', lambda m: setattr(m.header, 'frame_id', TEN_MEGABYTES)),
                 ('absurdly large', position(1e300)),
                 ('absurdly large', position(1e8)),
                 ('absurdly large', lambda m: setattr(m.twist.twist.linear, 'z', -1e8)),
                 ('bad orientation', norm(0.0)),
                 ('bad orientation', norm(1e150)),
                 ('too long', lambda m: setattr(m, 'child_frame_id', TEN_MEGABYTES)),
                 ('unknown frame', lambda m: setattr(m.header, 'frame_id', 'y' * 3000)),
                 ('unknown frame', lambda m: setattr(m.header, 'frame_id', 'nowhere')),
                 ('too old', lambda m: setattr(m.header, 'stamp', rospy.Time())),
                 ('from the future', lambda m: setattr(m.header, 'stamp', rospy.Time(4e9))),
                 ('out of order', lambda m: setattr(m.header, 'stamp',
                                                    m.header.stamp - rospy.Duration(0.3))))
        self.assert_counted(UAV2, [(reason, functools.partial(publish, spoil)) for reason, spoil in table])

    def test_same_odometry_without_a_defect_is_used(self):
        fault_reasons = ('not finite', 'absurdly large', 'bad orientation', 'too long', 'unknown frame', 'too old')
        self.diagnostics.settled_count(UAV2, DROPPED[UAV2])
        before = [self.dropped(UAV2, reason) for reason in fault_reasons]
        self.vehicles[1].spoil = lambda message: None
        rate = rospy.Rate(20)
        end = rospy.Time.now() + rospy.Duration(1.5)
        while rospy.Time.now() < end:
            self.odometry.publish(self.good_odometry())
            rate.sleep()
        uav2 = self.planner.uav('uav2')
        self.vehicles[1].spoil = lambda message: message
        self.assertEqual(uav2.state, UavStatus.TRACKING, uav2.reason)
        self.assertEqual([self.dropped(UAV2, reason) for reason in fault_reasons], before)

    def near_uav1(self):
        position, _ = self.vehicles[0].state(rospy.Time.now())
        return (position[0] + 8.0, -6.0, 20.0)

    def test_hundred_thousand_tracks_and_the_near_one_is_avoided(self):
        far = [(1000.0 + i % 300, 1000.0 + i // 300, 500.0) for i in range(99999)]
        raw = track_array([(0, 0, 0)] + far, rospy.Time(0))
        first = len(track_array([], rospy.Time(0))) + 4
        sent = rospy.Time(0)

        def publish():
            # One at a time: a planner that a sanitizer slows down takes so long to read one that the next is too old.
            nonlocal sent
            stamp = rospy.Time.now()
            if stamp < sent + rospy.Duration(1.5):
                return
            sent = stamp
            array = bytearray(raw)
            struct.pack_into('<II', array, 4, stamp.secs, stamp.nsecs)
            struct.pack_into('<3d', array, first, *self.near_uav1())
            self.tracks.publish(bytes(array))

        self.assertTrue(math.isinf(self.planner.uav('uav1').obstacle_clearance))
        self.assert_counted(TRACKS, [('too many', publish)])

        def avoided():
            publish()
            rospy.sleep(0.1)
            return math.isfinite(self.planner.uav('uav1').obstacle_clearance)
        wait_for(avoided, 'a clearance to the near one')

        def told():
            publish()
            rospy.sleep(0.1)
            entry = self.diagnostics.entry(TRACKS)
            return entry.level == DiagnosticStatus.ERROR and 'too many tracks: the 1000 nearest' in entry.message
        wait_for(told, 'an error that says so')

    def test_more_tracks_than_are_read_and_other_bad_arrays(self):
        far = [(1000.0, 1000.0, 500.0)] * 115000
        def publish(raw):
            self.tracks.publish(raw() if callable(raw) else raw)

        table = (('too long', track_array(far, rospy.Time(1))),
                 ('too long', track_array([], rospy.Time(1), TEN_MEGABYTES.encode() * 2)),
                 ('unknown frame', lambda: track_array([], rospy.Time.now(), TEN_MEGABYTES.encode())),
                 ('malformed', b'\0' * 12 + b'\3\0\0\0map\xff\xff\xff\x02'),
                 ('malformed', b'\0\0'),
                 ('too old', track_array([], rospy.Time(0))),
                 ('from the future', track_array([], rospy.Time(4e9))))
        self.assert_counted(TRACKS, [(reason, functools.partial(publish, raw)) for reason, raw in table])

    def test_bad_tracks_in_a_good_array(self):
        def publish(center):
            self.tracks.publish(track_array([center], rospy.Time.now()))

        table = (('not finite', (math.nan, 0, 0)), ('absurdly large', (0, 1e300, 0)), ('absurdly large', (0, 0, 1e8)))
        self.assert_counted(TRACKS, [(reason, functools.partial(publish, center)) for reason, center in table])

    def test_a_few_good_tracks_are_neither_too_many_nor_bad(self):
        before = self.diagnostics.settled_count(TRACKS, DROPPED[TRACKS])

        def seen():
            self.tracks.publish(track_array([self.near_uav1(), (300.0, 0.0, 0.0)], rospy.Time.now()))
            rospy.sleep(0.1)
            return math.isfinite(self.planner.uav('uav1').obstacle_clearance)
        wait_for(seen, 'a clearance to the obstacle')
        self.assertEqual(self.diagnostics.settled_count(TRACKS, DROPPED[TRACKS]), before)

    def test_transforms(self):
        def spoiled(change):
            transform = TransformStamped()
            transform.header.frame_id = 'map'
            transform.header.stamp = rospy.Time.now()
            transform.child_frame_id = 'odom'
            transform.transform.rotation.w = 1.0
            change(transform)
            return TFMessage([transform])

        def publish(change):
            self.transforms.publish(spoiled(change))

        table = (('not finite', lambda t: setattr(t.transform.translation, 'x', math.inf)),
                 ('absurdly large', lambda t: setattr(t.transform.translation, 'x', 1e300)),
                 ('bad orientation', lambda t: setattr(t.transform.rotation, 'w', 0.0)),
                 ('from the future', lambda t: setattr(t.header, 'stamp', rospy.Time(4e9))),
                 ('unknown frame', lambda t: setattr(t, 'child_frame_id', 'z' * 1000)),
                 ('unknown frame', lambda t: setattr(t, 'child_frame_id', 'map')),
                 ('too long', lambda t: setattr(t, 'child_frame_id', TEN_MEGABYTES)))
        self.assert_counted(TRANSFORMS, [(reason, functools.partial(publish, change)) for reason, change in table])
        before = self.diagnostics.settled_count(TRANSFORMS, DROPPED[TRANSFORMS])
        for _ in range(5):
            self.transforms.publish(spoiled(lambda t: None))
            rospy.sleep(0.1)
        self.assertEqual(self.diagnostics.settled_count(TRANSFORMS, DROPPED[TRANSFORMS]), before)

    def test_set_reference(self):
        def request(uav='uav3', path=(Point(0, 20, 20), Point(400, 20, 20)), start=0.0, speed=2.0, frame='map'):
            message = SetReferenceRequest(uav=uav, start=start, speed=speed, path=list(path))
            message.header.frame_id = frame
            return message

        refused = self.diagnostics.count(CYCLE, 'references refused')
        bad = (request(path=[Point(1, 2, 3)] * 1000000), request(uav=TEN_MEGABYTES), request(frame=TEN_MEGABYTES),
               request(uav='u' * 2000), request(frame='f' * 2000), request(path=[Point(1e300, 0, 0)]),
               request(path=[Point(0, 1e8, 0)]), request(path=[Point(0, 0, math.nan)]), request(speed=1e300),
               request(start=math.inf), request(path=[Point(1, 2, 3)] * 10001), request(path=[]))
        for each in bad:
            response = self.set_reference(each)
            self.assertFalse(response.success)
            self.assertLess(len(response.message), 600)
            self.assertNotEqual(response.message, '')
        self.diagnostics.wait_for_count(CYCLE, 'references refused', refused + len(bad) - 1)
        response = self.set_reference(request())
        self.assertTrue(response.success, response.message)

    def misses_and_load_while(self, action):
        """Deadline misses and processor time of the planner, per cycle, and what the action returns."""
        self.planner.status.clear()
        time_before = processor_time_of(self.pid)
        result = action()
        load = processor_time_of(self.pid) - time_before
        statuses = self.planner.status.all()
        self.assertGreater(len(statuses), 3)
        self.assertEqual(self.lost_since(statuses), [])
        misses = sum(status.deadline_missed for status in statuses)
        cycle = sorted(status.cycle_time for status in statuses)[len(statuses) // 2]
        rospy.loginfo('%d cycles, %d missed, median %.2f ms, %.2f s of processor time', len(statuses), misses,
                      1e3 * cycle, load)
        return misses, result

    def test_flood_of_every_topic_at_ten_kilohertz(self):
        quiet, _ = self.misses_and_load_while(lambda: rospy.sleep(3.0))
        before = self.dropped(UAV2, 'not finite')
        topics = ['/uav2/odometry', '/obstacle_tracks', '/tf']
        flooded, rate = self.misses_and_load_while(lambda: flood(3.0, 10000, topics))
        rospy.loginfo('flood of %.0f messages per second and topic', rate)
        self.assertGreater(rate, 1000.0)
        # Where the whole machine is late it is late without the flood, too; two more are a hiccup.
        self.assertLessEqual(flooded, 2 * quiet + 2)
        self.diagnostics.wait_for_count(UAV2, DROPPED[UAV2] + ': not finite', before + 1000)
        # Nobody read a sentence for each.
        self.assertLess(self.console.count('/planner_node'), 400)


if __name__ == '__main__':
    rostest.rosrun('swarm_planner', 'bad_input', BadInputTest)
