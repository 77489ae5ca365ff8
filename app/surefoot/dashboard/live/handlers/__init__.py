"""What each command about world, controller and settings does to a live run, and what it has to say."""
