"""The page: a Panel server around `bearingcore`. It draws and asks; it holds no physics.

One direction: controls -> Scene -> Results -> views (`explorer.py`).
"""
