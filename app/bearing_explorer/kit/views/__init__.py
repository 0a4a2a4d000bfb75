"""The parts that views of both halves are made of."""
