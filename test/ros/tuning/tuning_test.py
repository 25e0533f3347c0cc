#!/usr/bin/python3
"""Gains and laws changed in flight: by dynamic_reconfigure, and by rosparam and a reload."""
import copy
import os
import sys
import unittest

import rospkg
import rospy
import rostest
import yaml
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.msg import DoubleParameter
from dynamic_reconfigure.srv import Reconfigure, ReconfigureRequest
from std_msgs.msg import String
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from uav import PACKAGE, Uav  # noqa: E402

GAINS = '/uav/controller/gains'
CONFIG = os.path.join(rospkg.RosPack().get_path(PACKAGE), 'config', 'controller')
# Some names by hand; the others are found by trying.
PLACES = {
    'asmc': {'position_slope_z': ('position', 'slope', 2), 'max_tilt_deg': ('max_tilt_deg',),
             'attitude_leak_2': ('attitude', 'leak', 2),
             'mass_estimate_initial': ('mass_estimate', 'initial')},
    'geometric': {'rate_gain_y': ('rate_gain', 1)},
    'smc': {'attitude_nominal_x': ('attitude', 'nominal', 0)},
    'switched': {'switching_policy': ('switching_policy',),
                 'initial_subsystem': ('initial_subsystem',),
                 'subsystems_3_rate_gain_pitch': ('subsystems', 2, 'rate_gain', 2),
                 'subsystems_1_leak_0': ('subsystems', 0, 'leak', 0)}}


def gains_of(law):
    with open(os.path.join(CONFIG, law + '.yaml')) as file:
        return yaml.safe_load(file)


def leaves(tree):
    """The path and the value of every gain of a tree."""
    for key, value in tree.items() if isinstance(tree, dict) else enumerate(tree):
        if isinstance(value, (dict, list)):
            for path, leaf in leaves(value):
                yield (key,) + path, leaf
        elif key != 'law':
            yield (key,), value


def at(tree, path):
    for key in path:
        tree = tree[key]
    return tree


def replaced(tree, path, value):
    """A copy of a tree with another value at a path."""
    tree = copy.deepcopy(tree)
    at(tree, path[:-1])[path[-1]] = value
    return tree


def other(value, number):
    """A value that does as well, another one for every number from 1 on."""
    if isinstance(value, str):
        return {'refuse': 'warn', 'warn': 'refuse'}[value]
    return value + 1 if isinstance(value, int) else (1.0 + 1e-4 * number) * value


class Tuning(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node('tuning_test')
        cls.uav = Uav()
        cls.uav.wait_until_ready()
        cls.flown = {}  # the gains that fly, as the controller says after every change
        rospy.Subscriber('/uav/controller/parameters', String, cls.take_flown)
        cls.uav.wait('the gains', lambda: cls.flown)
        rospy.wait_for_service('/uav/controller/reload_parameters', timeout=20)
        cls.reload = rospy.ServiceProxy('/uav/controller/reload_parameters', Trigger)

    def setUp(self):
        """Hovering with the gains of asmc's file, and all that was learned at rest."""
        rospy.set_param(GAINS, gains_of('asmc'))
        if self.flown != gains_of('asmc'):
            # A law takes over near the set point only.
            here = self.uav.state.position
            self.uav.go(here.x, here.y, here.z)
            self.take_over('asmc')
        self.uav.go(0, 0, 1.5)
        self.uav.wait('the hover', lambda: self.uav.error() < 0.05)
        self.uav.sleep(15.0)

    @classmethod
    def take_flown(cls, message):
        with cls.uav.changed:
            cls.flown = yaml.load(message.data, Loader=yaml.CSafeLoader)['gains']
            cls.uav.changed.notify_all()

    def change_law(self, law):
        rospy.delete_param(GAINS)
        rospy.set_param(GAINS, gains_of(law))
        return self.reload()

    def take_over(self, law):
        response = self.change_law(law)
        self.assertTrue(response.success, response.message)
        self.uav.wait('the law ' + law, lambda: self.uav.state.controller == law)

    def check_every_gain(self, law):
        """Changes every gain both ways; `law` must be flying with the gains of its file."""
        gains = gains_of(law)
        client = Client('/uav/controller/tuning', timeout=20)
        self.uav.wait('the gains of the file', lambda: self.flown == gains)
        paths = {}
        for number, gain in enumerate(client.get_parameter_descriptions(timeout=20), 1):
            name = gain['name']
            value = other(client.get_configuration()[name], number)
            self.assertEqual(client.update_configuration({name: value})[name], value, name)
            self.uav.wait(name + ' by dynamic_reconfigure', lambda: self.flown != gains)
            paths[name] = self.changed_place(gains, self.flown, value)
            gains = self.flown
            self.assertEqual(rospy.get_param(GAINS), gains, name)
        self.check_places(law, paths)
        # By rosparam all at once, since no value is that of another gain; then back.
        for number, path in enumerate(paths.values(), 1):
            gains = replaced(gains, path, other(at(gains, path), number))
        for wanted in (gains, gains_of(law)):
            rospy.set_param(GAINS, wanted)
            response = self.reload()
            self.assertTrue(response.success, response.message)
            self.uav.wait('the gains by rosparam', lambda: self.flown == wanted)
            self.uav.wait('dynamic_reconfigure to follow', lambda: all(
                client.get_configuration()[name] == at(wanted, path)
                for name, path in paths.items()))

    def changed_place(self, before, after, value):
        """The path of the one gain in which two trees differ; it is `value` now."""
        before, after = dict(leaves(before)), dict(leaves(after))
        self.assertEqual(before.keys(), after.keys())
        changed = [(path, new) for path, new in after.items() if new != before[path]]
        self.assertEqual(len(changed), 1, changed)
        self.assertEqual(changed[0][1], value)
        return changed[0][0]

    def check_places(self, law, paths):
        """Every gain of the file has one name in dynamic_reconfigure, and the other way round."""
        self.assertEqual(sorted(paths.values(), key=repr),
                         sorted(dict(leaves(gains_of(law))), key=repr))
        for name, path in PLACES[law].items():
            self.assertEqual(paths[name], path, name)

    def test_every_gain_is_reachable_both_ways(self):
        self.check_every_gain('asmc')
        self.uav.sleep(5.0)
        self.assertLess(self.uav.error(), 0.05)

    def test_a_gain_works_as_soon_as_it_is_changed(self):
        client = Client('/uav/controller/tuning', timeout=20)
        sag = self.uav.state.position_error.z
        client.update_configuration({'mass_estimate_leak': 1.0})
        self.uav.sleep(15.0)
        self.assertLess(self.uav.state.position_error.z, sag - 0.05)
        rospy.set_param(GAINS + '/mass_estimate/leak', 0.1)
        self.assertTrue(self.reload().success)
        self.uav.sleep(15.0)
        self.assertAlmostEqual(self.uav.state.position_error.z, sag, delta=0.02)

    def test_a_wrong_set_is_refused_whole(self):
        before = self.uav.state
        rospy.set_param(GAINS + '/position/slope', [5.0, 5.0, 5.0])
        rospy.set_param(GAINS + '/attitude/boundary_layer', -1.0)
        response = self.reload()
        self.assertFalse(response.success)
        for word in ('nothing changed', GAINS + '/attitude/boundary_layer', '-1', '> 0'):
            self.assertIn(word, response.message)
        client = Client('/uav/controller/tuning', timeout=20)
        self.assertEqual(client.get_configuration()['position_slope_x'], 1.2)
        self.uav.sleep(2.0)
        self.assertAlmostEqual(self.uav.state.thrust, before.thrust, delta=0.05)

    def test_what_is_out_of_range_or_unknown_is_refused_whole(self):
        client = Client('/uav/controller/tuning', timeout=20)
        before = client.get_configuration()
        ranges = {gain['name']: (gain['min'], gain['max'])
                  for gain in client.get_parameter_descriptions(timeout=20)}
        self.assertEqual(ranges['max_tilt_deg'], (0.0, 89.0))
        for wrong in ({'max_tilt_deg': 89.5, 'min_lift': 3.0},
                      {'position_slope_x': -1.0, 'min_lift': 3.0}):
            answer = client.update_configuration(wrong)
            for name, value in before.items():
                if name != 'groups':
                    self.assertEqual(answer[name], value, name)
        request = ReconfigureRequest()
        request.config.doubles = [DoubleParameter('min_lift', 3.0), DoubleParameter('nobody', 1.0)]
        answer = rospy.ServiceProxy('/uav/controller/tuning/set_parameters', Reconfigure)(request)
        self.assertIn(DoubleParameter('min_lift', before['min_lift']), answer.config.doubles)
        self.assertEqual(rospy.get_param(GAINS + '/min_lift'), before['min_lift'])

    def test_laws_take_over_without_a_drop(self):
        for law in ('geometric', 'asmc', 'smc', 'asmc'):
            before = self.uav.state
            self.take_over(law)
            self.uav.sleep(12.0)
            since = [s for s in self.uav.states if s.header.stamp > before.header.stamp]
            first = next(s for s in since if s.controller == law)
            self.assertAlmostEqual(first.thrust, before.thrust, delta=0.25 * before.thrust)
            self.assertGreater(min(s.position.z for s in since), before.position.z - 0.12, law)
            self.assertLess(self.uav.error(), 0.12, law)

    def test_no_law_takes_over_far_from_the_set_point(self):
        self.uav.go(6, 0, 1.5)
        response = self.change_law('geometric')
        self.assertFalse(response.success)
        self.assertIn("'geometric' cannot take over from 'asmc'", response.message)
        self.assertRegex(response.message, 'at most|rotors are saturated')
        self.uav.sleep(25.0)
        self.assertEqual(self.uav.state.controller, 'asmc')
        self.assertLess(self.uav.error(), 0.1)

    def test_every_gain_of_the_other_laws_is_reachable_both_ways(self):
        for law in ('geometric', 'smc', 'switched'):  # last the one that lets x and y go
            self.take_over(law)
            self.uav.sleep(8.0)
            self.check_every_gain(law)


if __name__ == '__main__':
    rostest.rosrun(PACKAGE, 'tuning', Tuning, sys.argv)
