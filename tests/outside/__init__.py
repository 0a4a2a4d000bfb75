"""Numbers from outside: published tables, public programs, and short computations of their own."""
