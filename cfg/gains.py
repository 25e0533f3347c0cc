"""What the .cfg files share: a law's gains for dynamic_reconfigure, with the values of its YAML file.

The name of a gain is its path in that file, joined by underscores, and for an entry of a list the
name of its axis or its index: position/slope[2] is position_slope_z.
"""
import os
import sys

import yaml

sys.dont_write_bytecode = True  # nothing is to appear in the source tree
from dynamic_reconfigure.parameter_generator_catkin import (  # noqa: E402
    ParameterGenerator, double_t, int_t, str_t)

PACKAGE = 'adaptive_quadrotor_control'
CONFIG = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'config', 'controller')
AXES = {3: ['x', 'y', 'z'], 4: ['z', 'roll', 'pitch', 'yaw']}


class Law:
    """Collects the gains of config/controller/<name>.yaml."""

    def __init__(self, name):
        with open(os.path.join(CONFIG, name + '.yaml')) as file:
            self.values = yaml.safe_load(file)
        self.generator = ParameterGenerator()

    def group(self, path, title, gains):
        """Adds gains as (name, description with symbol and unit, least, largest[, 'index'])."""
        values, prefix = self.values, ''
        for key in path:
            values = values[key]
            prefix += '%s_' % (key + 1 if isinstance(key, int) else key)  # lists count from 1
        group = self.generator.add_group(title)
        for name, description, least, largest, *by_index in gains:
            value = values[name]
            full = prefix + name
            if not isinstance(value, list):
                self._add(group, full, description, value, least, largest)
                continue
            axes = AXES.get(len(value), range(len(value)))
            for i, axis in enumerate(range(len(value)) if by_index else axes):
                self._add(group, '%s_%s' % (full, axis), '%s, %s' % (description, axis), value[i],
                          least, largest)

    @staticmethod
    def _add(group, name, description, value, least, largest):
        kind = int_t if isinstance(least, int) else double_t
        group.add(name, kind, 0, description, kind_of(kind)(value), least, largest)

    def choice(self, name, description, options):
        """Adds a text that must be one of some."""
        enum = self.generator.enum([self.generator.const(option, str_t, option, option)
                                    for option in options], description)
        self.generator.add(name, str_t, 0, description, self.values[name], edit_method=enum)

    def generate(self, name):
        sys.exit(self.generator.generate(PACKAGE, PACKAGE, name))


def kind_of(kind):
    return int if kind == int_t else float


TILT = [
    ('max_tilt_deg', 'largest tilt commanded [deg]', 1.0, 89.0),
    ('min_lift', 'least vertical force that decides the commanded attitude [N]', 0.01, 50.0),
]
