"""What the tests of the guard share: a vehicle that is armed by services and whose odometry goes
through this process, to be spoiled on the way."""
import rospy
from adaptive_quadrotor_control.srv import GoTo
from geometry_msgs.msg import Point
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger
from uav import Uav


class GuardedUav(Uav):
    """A Uav whose controller hears `/uav/heard`: what `spoil` makes of the plant's odometry."""

    def __init__(self):
        super().__init__()
        self.spoil = lambda message: message  # None: nothing is heard
        self.relay = rospy.Publisher('/uav/heard', Odometry, queue_size=10, tcp_nodelay=True)
        rospy.Subscriber('/uav/odometry', Odometry, self._pass_on, tcp_nodelay=True)

    def _pass_on(self, message):
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

    def expect_landed(self, test):
        self.wait_mode('disarmed')
        self.sleep(1.0)
        test.assertFalse(self.status.crashed, self.status.crash_reason)
        test.assertEqual(list(self.motors[-1].angular_velocities), [0.0] * 4)
