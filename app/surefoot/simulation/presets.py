"""The presets that sensors, motors and model error have in common, and what they stand for."""

PERFECT, LAB, ROBOT, CHEAP = "perfect", "lab", "robot", "cheap"
PRESETS = (PERFECT, LAB, ROBOT, CHEAP)
PRESET_HELP = "perfect: none; lab: the best there is; robot: a good one of today; cheap: what learned controllers bear"
MOST_SEEDS = 2**31 - 1  # the greatest seed that may be asked for
