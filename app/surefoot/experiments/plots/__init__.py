"""The figures. Matplotlib lives here and nowhere else; nothing here runs or judges anything."""
