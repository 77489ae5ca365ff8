"""All that a user can ask of the session; ``from ... import commands as cmd`` names every command.

A new one is a record in a file below, and nothing here.
"""

from surefoot.dashboard.messages.command_base import *
from surefoot.dashboard.messages.disturbance_commands import *
from surefoot.dashboard.messages.playback_commands import *
from surefoot.dashboard.messages.tuning_commands import *
from surefoot.dashboard.messages.twin_commands import *
from surefoot.dashboard.messages.walk_commands import *
