"""What the tests of the guard share: a vehicle that is armed by services and whose odometry goes
through this process, to be spoiled on the way."""
import os
import signal
import sys
import unittest
from xmlrpc.client import ServerProxy

import rospy
import rostest
from adaptive_quadrotor_control.srv import ApplyDisturbance, AttachPayload, GoTo
from geometry_msgs.msg import Point, Vector3
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger
from uav import PACKAGE, Uav


def kill_node(name):
    """kill -9 of a node's process."""
    master = ServerProxy(os.environ['ROS_MASTER_URI'])
    uri = master.lookupNode('/test', name)[2]
    os.kill(ServerProxy(uri).getPid('/test')[2], signal.SIGKILL)


def run(test):
    """Runs a GuardedTest under rostest."""
    rostest.rosrun(PACKAGE, 'guard_' + test.__name__.lower(), test, sys.argv)


class GuardedUav(Uav):
    """A Uav whose controller hears `/uav/heard`: what `spoil` makes of the plant's odometry."""

    def __init__(self):
        super().__init__()
        self.spoil = lambda message: message  # None: nothing is heard
        self.truth = None  # the latest odometry of the plant
        self.relay = rospy.Publisher('/uav/heard', Odometry, queue_size=10, tcp_nodelay=True)
        rospy.Subscriber('/uav/odometry', Odometry, self._pass_on, tcp_nodelay=True)

    @property
    def now(self):
        """Simulated time; the controller's states stand still without odometry."""
        return self.status.header.stamp.to_sec()

    def _pass_on(self, message):
        at = message.pose.pose.position
        self.truth = Point(at.x, at.y, at.z)  # of its own: `spoil` may change the message
        spoiled = self.spoil(message)
        if spoiled is not None:
            self.relay.publish(spoiled)

    def order(self, name):
        """Calls a service of the guard; the answer."""
        service = '/uav/controller/' + name
        rospy.wait_for_service(service, 10.0)
        return rospy.ServiceProxy(service, Trigger)()

    def obey(self, name):
        answer = self.order(name)
        assert answer.success, '%s: %s' % (name, answer.message)

    def go_to(self, x, y, z, yaw=0.0):
        service = rospy.ServiceProxy('/uav/controller/go_to', GoTo)
        return service(Point(x, y, z), yaw)

    def wait_mode(self, mode):
        self.wait('the mode ' + mode, lambda: self.state.mode == mode)

    def take_off(self):
        self.wait_until_ready()
        self.wait('odometry', lambda: self.state.odometry_silence < 0.1)
        self.sleep(0.5)
        self.obey('arm')
        self.obey('take_off')
        self.wait_mode('holding')
        self.sleep(3.0)

    def call(self, kind, service, **request):
        """A service of the plant; fails when it refuses."""
        answer = rospy.ServiceProxy('/uav/plant/' + service, kind)(**request)
        assert answer.success, '%s: %s' % (service, answer.message)

    def push(self, seconds, force=(0.0, 0.0, 0.0), moment=(0.0, 0.0, 0.0)):
        self.call(ApplyDisturbance, 'apply_disturbance', for_so_long=rospy.Duration(seconds),
                  force=Vector3(*force), moment=Vector3(*moment))

    def attach(self, mass):
        """A small box of so many kilograms below the vehicle."""
        self.call(AttachPayload, 'attach_payload', name='load', mass=mass,
                  size=Vector3(0.1, 0.1, 0.1), offset=Vector3(0.0, 0.0, -0.06))


class GuardedTest(unittest.TestCase):
    """A test of one situation; `self.uav` is the vehicle."""

    def setUp(self):
        rospy.init_node(type(self).__name__.lower() + '_test')
        self.uav = GuardedUav()

    def expect_landed(self):
        """On the ground, whole, the rotors still."""
        self.uav.wait_mode('disarmed')
        self.uav.wait('still rotors', lambda: max(
            self.uav.motors[-1].angular_velocities) == 0.0)
        self.uav.wait('contact', lambda: self.uav.status.touching)
        self.assertFalse(self.uav.status.crashed, self.uav.status.crash_reason)

    def expect_holding(self, reason=None, error=0.2):
        self.uav.wait_mode('holding')
        if reason:
            self.assertEqual(self.uav.state.mode_reason, reason)
        self.uav.sleep(4.0)
        self.assertEqual(self.uav.state.mode, 'holding')
        self.assertLess(self.uav.error(), error)
        self.assertFalse(self.uav.status.crashed, self.uav.status.crash_reason)
