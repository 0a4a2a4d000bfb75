"""Numbers from outside: printed tables, public programs, short computations of their own."""
