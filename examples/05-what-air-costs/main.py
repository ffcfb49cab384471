"""The same four steps with three kinds of valves, the distance walked on half a litre of air, and a leak."""

import sinew

print("experiment             way [m]  passiveness  air per step [g]")
for name in ("walk-test-1", "walk-3-way", "walk-with-regulators"):
    found = sinew.run(sinew.shipped(f"experiments/{name}.toml")).summary
    # A regulator is never shut, nor open.
    passiveness = f"{found['passiveness']:.3f}" if "passiveness" in found else "-"
    way, air = found["trolley"]["distance_m"], found["air_used_per_step_kg"]
    print(f"{name:<20} {way:9.2f} {passiveness:>12}{1e3 * air:18.3f}")

supply = sinew.run(sinew.shipped("experiments/endurance.toml")).summary["supply"]
print(
    f"\nhalf a litre: {supply['full_steps']:.0f} steps, {supply['full_distance_m']:.1f} m "
    f"in {supply['full_time_s']:.0f} s"
)

# Many runs in parallel on two cores give a table with a row for each.
rows = sinew.sweep(
    sinew.shipped("experiments/walk-test-1.toml"),
    {"muscle.knee_flexor.leak.area": "0,0.01,0.1 mm2"},
    report=["trolley.distance_m [in]", "air_used_per_step_kg [g]"],
    threads=2,
)
print("\nleak [mm2]  way [in]  air per step [g]")
for row in rows:
    print(
        f"{row['muscle.knee_flexor.leak.area [mm2]']:10g} {row['trolley.distance [in]']:9.1f} "
        f"{row['air_used_per_step [g]']:17.3f}  {row['status']}"
    )
