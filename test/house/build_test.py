#!/usr/bin/python3
"""What can be built without what, and that the installed core is enough to fly.

Environment: SOURCE and BUILD, the package and where it was built; DEVEL, the devel space, empty
without catkin; CMAKE, the program.
"""
import os
import shutil
import subprocess
import unittest

SOURCE, BUILD, DEVEL, CMAKE = map(os.environ.get, ('SOURCE', 'BUILD', 'DEVEL', 'CMAKE'))
WORK = os.path.join(BUILD, 'build_test')


def run(*command):
    """Exit code and all that was printed."""
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            universal_newlines=True, timeout=300)
    return result.returncode, result.stdout


class Build(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(WORK, ignore_errors=True)

    def do(self, *command):
        code, text = run(*command)
        self.assertEqual(code, 0, text)
        return text

    def configure(self, *options):
        return run(CMAKE, '-S', SOURCE, '-B', WORK, *options)

    def hiding(self, packages):
        return ['-DCMAKE_DISABLE_FIND_PACKAGE_%s=TRUE' % package for package in packages]

    def fly_example(self, prefix):
        self.do(CMAKE, '-S', os.path.join(SOURCE, 'examples'), '-B', WORK,
                '-DCMAKE_PREFIX_PATH=' + prefix, '-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF')
        self.do(CMAKE, '--build', WORK)
        lines = self.do(os.path.join(WORK, 'hover'), os.path.join(SOURCE, 'config')).splitlines()
        self.assertEqual(lines[0], 'time [s]  height [m]  thrust [N]')
        return [[float(word) for word in line.split()] for line in lines[1:]]

    def test_the_example_flies_on_the_installed_core_alone(self):
        prefix = os.path.join(WORK, 'installed')
        self.do(CMAKE, '--install', BUILD, '--prefix', prefix, '--component', 'core')
        for folder, _, files in os.walk(prefix):
            for name in files:
                if name.endswith('.cmake'):
                    with open(os.path.join(folder, name)) as file:
                        self.assertNotIn(SOURCE, file.read(), name)
        rows = self.fly_example(prefix)
        self.assertEqual([row[0] for row in rows], list(range(0, 41, 4)))
        weight = {16: 2.0 * 9.81, 40: 2.5 * 9.81}  # [N], before and with the payload
        for time, height, thrust in rows:
            if time in weight:
                self.assertAlmostEqual(height, 1.0, delta=0.05)
                self.assertAlmostEqual(thrust, weight[time], delta=0.05)

    @unittest.skipUnless(DEVEL, 'without catkin there is no devel space')
    def test_the_devel_space_has_the_core_too(self):
        text = self.do(CMAKE, '-S', os.path.join(SOURCE, 'examples'), '-B', WORK,
                       '-DCMAKE_PREFIX_PATH=' + DEVEL)
        self.assertIn('Generating done', text)

    def test_what_is_not_found_is_left_out_and_named(self):
        code, text = self.configure('-DAQC_ROS=OFF', *self.hiding(['CLI11']))
        self.assertEqual(code, 0, text)
        self.assertIn('Left out for lack of CLI11: the programs that fly and draw', text)

    def test_what_is_insisted_on_must_be_there(self):
        code, text = self.configure('-DAQC_ROS=OFF', '-DAQC_TOOLS=ON', *self.hiding(['CLI11']))
        self.assertNotEqual(code, 0)
        self.assertIn('CLI11', text)

    @unittest.skipUnless(DEVEL, 'without catkin there is nothing to show')
    def test_a_display_without_tools_cannot_be_insisted_on(self):
        code, text = self.configure('-DAQC_DISPLAY=ON', '-DAQC_TOOLS=OFF')
        self.assertNotEqual(code, 0)
        self.assertIn('needs AQC_TOOLS', text)

    @unittest.skipUnless(DEVEL, 'this is about a catkin workspace')
    def test_a_vehicle_needs_neither_tools_nor_display(self):
        code, text = self.configure('-DAQC_TOOLS=OFF', '-DAQC_DISPLAY=OFF')
        self.assertEqual(code, 0, text)
        with open(os.path.join(WORK, 'CMakeCache.txt')) as file:
            cache = file.read()
        for package in ['CLI11', 'nlohmann_json', 'rosbag', 'interactive_markers',
                        'visualization_msgs']:
            self.assertNotIn('\n%s_DIR' % package, cache)

    @unittest.skipUnless(DEVEL, 'this is about a catkin workspace')
    def test_a_workspace_needs_nothing_that_only_tests_use(self):
        programs = {'CLANG_FORMAT': 'clang-format', 'CATKIN_LINT': 'catkin_lint',
                    'CLANG_TIDY': 'clang-tidy', 'VALGRIND': 'valgrind'}
        packages = ['rapidcheck', 'rostest']
        code, text = self.configure('-DCATKIN_ENABLE_TESTING=ON', *self.hiding(packages),
                                    *['-D%s=' % variable for variable in programs])
        self.assertEqual(code, 0, text)
        told = '\n'.join(line for line in text.splitlines() if 'Left out' in line)
        for name in packages + list(programs.values()):
            self.assertIn(name, told)

    def test_unknown_sanitizers_are_refused(self):
        code, text = self.configure('-DAQC_ROS=OFF', '-DAQC_SANITIZE=magic')
        self.assertNotEqual(code, 0)
        for word in ("'magic'", 'address', 'undefined', 'thread'):
            self.assertIn(word, text)

    def test_sanitizers_that_exclude_each_other_are_refused(self):
        code, text = self.configure('-DAQC_ROS=OFF', '-DAQC_SANITIZE=address;thread')
        self.assertNotEqual(code, 0)
        self.assertIn("'address;thread'", ' '.join(text.split()))
        self.assertIn('exclude each other', ' '.join(text.split()))


if __name__ == '__main__':
    unittest.main()
