"""Above the tabs: status, run buttons, controller, timeline, visitors, the card after a fall."""
