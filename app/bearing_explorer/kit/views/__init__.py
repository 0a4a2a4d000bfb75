"""What views of both halves are made of."""
