"""The greatest length of the address of a page."""

TOO_LONG = "too-long"
"""Version of an address that the server put in place of one that was far too long."""

LONGEST_ADDRESS = 16_000
"""Characters of an address that reaches the page; links of the page have at most half of that.

A session's token holds the address and returns in a header: with a longer address, the page would
load but never connect.
"""
