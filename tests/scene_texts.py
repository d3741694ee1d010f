"""Tables that scenes of tests share."""

EXPERIMENTS = """
[sweep]
ramp = 0
start = 0
end = "1 s"
duration = "1 s"
lowest = 4
highest = 7
[curve]
lowest = 4
highest = 7
tolerance = 1e-3
[march]
time_step = "1 ms"
store_every = 1
"""
"""what is done with a system around 5 Hz"""
