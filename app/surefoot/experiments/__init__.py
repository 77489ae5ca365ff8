"""The questions: scenario files, headless runs and their summaries, grids of runs."""
