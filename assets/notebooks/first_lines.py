import math

from bearingcore import equilibrium, modes, presets, simulate

scene = presets["fan-rig"].replace(extent=math.radians(38.6))

state = equilibrium(scene)  # over one ball spacing
print(state.ball_load.max(), "N at most on a ball")
print(state.term("k_yy").max(), "N/m at most")
print(modes(scene).bands(), "Hz")

motion = simulate(scene, 1.4, 65536.0)  # s, samples a second
frequency, density = motion.spectrum()
print(motion.dofs, frequency[density.argmax(axis=0)], "Hz: the loudest lines")
