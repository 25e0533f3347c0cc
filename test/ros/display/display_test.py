#!/usr/bin/python3
"""What rviz is shown, what it sends back, the picture it makes, and a recording of it all."""
import math
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml
from collections import Counter

import rospkg
import rospy
import rostest
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit, MarkerArray

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, Uav, executable  # noqa: E402

SHARE = rospkg.RosPack().get_path(PACKAGE)
# Colours of the picture (red, green, blue), lit and unlit, and how many pixels there must be of them.
SEEN = {'vehicle': (((108, 75, 34), (127, 93, 52), (30, 64, 103), (57, 92, 131)), 300),
        'payload': (((195, 109, 38), (114, 64, 22)), 60),
        'flown path': (((248, 4, 44),), 60),
        'wall': (((54, 48, 43), (78, 68, 58)), 8000),
        'text': (((255, 255, 255),), 400),
        'view as wide as the window': (((28, 32, 40),), 800000)}


def numbers(marker):
    for point in marker.points + [marker.pose.position, marker.scale]:
        yield from (point.x, point.y, point.z)
    for colour in marker.colors + [marker.color]:
        yield from (colour.r, colour.g, colour.b, colour.a)


class Display(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('display_test')
        cls.uav = Uav()
        cls.markers = {}
        for topic in ('vehicle', 'paths'):
            rospy.Subscriber('/uav/display/' + topic, MarkerArray, cls.take)
        cls.goals = []
        rospy.Subscriber('/uav/goal/update_full', InteractiveMarkerInit, cls.take_goals)
        cls.transforms = {}
        rospy.Subscriber('/tf', TFMessage, lambda message: cls.transforms.update(
            {(t.header.frame_id, t.child_frame_id): t.transform for t in message.transforms}))
        cls.feedback = rospy.Publisher('/uav/goal/feedback', InteractiveMarkerFeedback,
                                       queue_size=1)
        cls.nav_goal = rospy.Publisher('/uav/move_base_simple/goal', PoseStamped, queue_size=1)
        cls.uav.wait_until_ready()

    def setUp(self):
        """Flying, where nothing is in the way, without payload."""
        if not self.uav.state.flying:
            self.take_off()
        if self.uav.status.payload_mass > 0:
            self.drop()
        self.drag(0.0, 0.0, 1.3)
        self.uav.wait('the hover', lambda: self.uav.error() < 0.1)

    @classmethod
    def take(cls, message):
        with cls.uav.changed:
            for marker in message.markers:
                cls.markers[marker.ns, marker.id] = marker
            cls.uav.changed.notify_all()

    @classmethod
    def take_goals(cls, message):
        with cls.uav.changed:
            cls.goals = message.markers  # none until the first odometry
            cls.uav.changed.notify_all()

    def shown(self, ns):
        return [m for (name, _), m in self.markers.items() if name == ns and m.action == m.ADD]

    def click(self, title):
        """An entry of the goal's menu."""
        self.uav.wait('the goal', lambda: self.goals)
        entry = next(e for e in self.goals[0].menu_entries if e.title == title)
        self.send(event_type=InteractiveMarkerFeedback.MENU_SELECT, menu_entry_id=entry.id)

    def send(self, **fields):
        self.uav.wait('the goal to listen', lambda: self.feedback.get_num_connections() > 0)
        message = InteractiveMarkerFeedback(client_id='test', marker_name='goal', **fields)
        message.header.frame_id = 'world'
        self.feedback.publish(message)

    def drag(self, x, y, z):
        """The goal, to there."""
        pose = Pose(position=Point(x, y, z), orientation=Quaternion(w=1.0))
        self.send(event_type=InteractiveMarkerFeedback.POSE_UPDATE, pose=pose)
        self.uav.wait('the drag', lambda: self.uav.state.desired_position == pose.position)

    def take_off(self):
        self.click('Take off')
        # The guard rises by 1 m from where the vehicle stands, which is at 0.1 m.
        self.uav.wait('the take-off', lambda: self.uav.state.flying and
                      self.uav.state.mode_reason == 'taken off' and
                      abs(self.uav.state.desired_position.z - 1.1) < 1e-3)
        self.uav.wait('the height', lambda: self.uav.state.position.z > 0.7)

    def attach(self):
        self.click('Attach 0.5 kg')
        self.uav.wait('the payload', lambda: self.uav.status.payload_mass == 0.5)

    def drop(self):
        self.click('Drop the payload')
        self.uav.wait('the drop', lambda: self.uav.status.payload_mass == 0)

    def test_the_goal_is_dragged(self):
        for x in (0.5, 1.0, 1.5):
            self.drag(x, -0.4, 1.3)

    def test_a_2d_goal_keeps_the_height(self):
        self.uav.wait('the goal node', lambda: self.nav_goal.get_num_connections() > 0)
        goal = PoseStamped()
        goal.header.frame_id = 'world'
        goal.pose.position.x, goal.pose.position.y = 5.0, -1.5
        goal.pose.orientation.w = 1.0
        self.nav_goal.publish(goal)
        self.uav.wait('the goal', lambda: self.uav.state.desired_position.x == 5.0)
        self.assertEqual(self.uav.state.desired_position.z, 1.3)

    def test_everything_is_shown(self):
        self.attach()
        self.uav.wait('all markers', lambda: all(self.shown(ns) for ns in (
            'walls', 'cargo', 'payload', 'thrust', 'set_point', 'text', 'plumb', 'flown',
            'reference')))
        self.assertEqual(len(self.shown('thrust')), 4)
        self.assertIn('asmc', self.shown('text')[0].text)
        for marker in self.markers.values():
            for number in numbers(marker):
                self.assertTrue(math.isfinite(number), marker.ns)
        for frames in (('world', 'base_link'), ('base_link', 'payload')):
            self.assertTrue(math.isfinite(self.transforms[frames].translation.z), frames)

    def test_the_vehicle_is_a_urdf(self):
        robot = xml.fromstring(rospy.get_param('/uav/robot_description'))
        self.assertEqual([link.get('name') for link in robot.findall('link')], ['base_link'])
        visuals = robot.find('link').findall('visual')
        self.assertGreater(len(visuals), 12)
        for visual in visuals:
            for number in visual.find('origin').get('xyz').split():
                self.assertTrue(math.isfinite(float(number)))

    def test_rviz_draws_it_on_both_sides_of_the_wall(self):
        self.fly_to(5.0, -1.5, 1.3)
        self.attach()
        picture = rospy.get_param('~picture')
        display = ':%d' % (60 + os.getpid() % 30)
        environment = dict(os.environ, DISPLAY=display)
        server = subprocess.Popen(['Xvfb', display, '-screen', '0', '1500x900x24'],
                                  stderr=subprocess.DEVNULL)
        rviz = None
        try:
            time.sleep(1.0)
            rviz = subprocess.Popen(
                ['rosrun', 'rviz', 'rviz', '-d', SHARE + '/config/view.rviz', '__ns:=uav'],
                env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.check_picture(picture, environment)
            # Up, over the wall; and back, in front of which the next test begins.
            self.addCleanup(self.fly_to, 5.0, -1.5, 3.6)
            self.fly_to(5.0, -1.5, 3.6)
            self.fly_to(9.5, -1.5, 3.6)
            root, extension = os.path.splitext(picture)
            self.check_picture(root + '_behind' + extension, environment)
        finally:
            for process in filter(None, (rviz, server)):
                process.terminate()
                process.wait()

    def fly_to(self, x, y, z):
        self.drag(x, y, z)
        self.uav.wait('the vehicle there', lambda: self.uav.error() < 0.3)

    def check_picture(self, picture, environment):
        """Takes a screenshot that shows everything, as soon as there is one."""
        missing, deadline = SEEN, time.time() + 90.0
        while missing and time.time() < deadline:
            time.sleep(1.0)
            subprocess.run(['import', '-window', 'root', picture], env=environment, check=True)
            missing = self.unseen(picture)
        self.assertFalse(missing, 'not in ' + picture)

    def unseen(self, picture):
        """What there is too little of in a picture, with the number of its pixels."""
        raw = subprocess.run(['convert', picture, '-depth', '8', 'rgb:-'], check=True,
                             stdout=subprocess.PIPE).stdout
        pixels = Counter(zip(raw[0::3], raw[1::3], raw[2::3]))
        missing = {}
        for name, (colours, least) in SEEN.items():
            count = sum(number for pixel, number in pixels.items() if any(
                all(abs(seen - wanted) < 12 for seen, wanted in zip(pixel, colour))
                for colour in colours))
            if count < least:
                missing[name] = count
        return missing

    def record(self, bag):
        """A flight with a payload for a while."""
        recorder = subprocess.Popen(
            ['roslaunch', PACKAGE, 'record.launch', 'bag:=' + bag], stdout=subprocess.DEVNULL)
        try:
            deadline = time.time() + 20.0
            while not os.path.exists(bag + '.active') and time.time() < deadline:
                time.sleep(0.1)
            self.uav.sleep(2.0)
            self.attach()
            self.uav.sleep(2.0)
            self.drop()
            self.uav.sleep(2.0)
        finally:
            recorder.terminate()
            recorder.wait(20)

    def test_a_recording_is_drawn(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        bag = os.path.join(self.folder, 'test.bag')
        self.record(bag)
        subprocess.run([executable('fly'), 'hover_payload', '--controller', 'smc', '--no-plots',
                        '--out', self.folder], check=True, timeout=100)
        self.plot(bag)
        converted = os.path.join(self.folder, 'test.csv')
        with open(converted, 'rb') as file:
            before = file.read()
        result = subprocess.run([executable('plot_flight'), bag, converted, '--out', self.folder],
                                stderr=subprocess.PIPE, timeout=100)
        self.assertEqual(result.returncode, 1)
        self.assertIn(b'would overwrite', result.stderr)
        with open(converted, 'rb') as file:
            self.assertEqual(file.read(), before)
        both = self.plot(bag, os.path.join(self.folder, 'smc.csv'))
        names = re.findall(r"NaN with lines .* title '(.*)'", both)
        self.assertEqual(names, ['set point', 'asmc', 'smc'])

    def plot(self, *files):
        """Draws recordings; returns the script of one of the figures."""
        subprocess.run([executable('plot_flight'), *files, '--out', self.folder], check=True,
                       timeout=100)
        for name in ('position', 'position_error', 'attitude_error', 'adaptation', 'rotors'):
            size = os.path.getsize(os.path.join(self.folder, name + '.png'))
            self.assertGreater(size, 5000, name)
        with open(os.path.join(self.folder, 'position.gnuplot')) as file:
            return file.read()


if __name__ == '__main__':
    rostest.rosrun(PACKAGE, 'display', Display, sys.argv)
