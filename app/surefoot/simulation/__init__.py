"""The world: MuJoCo, stones, pushes, a loop without a clock, a recorder. MuJoCo lives here."""
