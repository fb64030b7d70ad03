"""Models of the gallery with changed parameters."""
import re

from common import ROOT

NUMBER = re.compile(r'^(\w+) = "?(-?[0-9.]+(?:e-?[0-9]+)?)( [^"#*+/]*[A-Za-z%/^0-9]+)?"?(?:\s*#.*)?$')


def parameters(text):
    """{name: (number, unit)} of the parameters that are given as plain quantities."""
    block = text.split("[parameters]", 1)[-1].split("\n[", 1)[0] if "[parameters]" in text else ""
    return {m[1]: (float(m[2]), m[3] or "") for line in block.splitlines() if (m := NUMBER.match(line))}


def subject(rng):
    """A random model: some parameters times a factor, and the factor on all friction varied."""
    path = rng.choice(sorted((ROOT / "models").glob("*.toml")))
    text = path.read_text()
    known, settings = parameters(text), []
    for name in rng.sample(sorted(known), min(len(known), rng.randint(0, 2))):
        number, unit = known[name]
        settings += ["--set", f"{name}={number * rng.choice([0.8, 1.1, 1.25, rng.uniform(0.5, 2)]):.6g}{unit}"]
    frictions = [name for name in known if name.startswith("mu") and known[name][1] == ""]
    if not frictions:
        return text, "friction", (0.0, 2.0), settings, None
    name = rng.choice(frictions)
    settings = [s for pair in zip(settings[::2], settings[1::2]) if not pair[1].startswith(f"{name}=") for s in pair]
    return text, name, (0.0, rng.choice([0.5, 1.0, 2.0])), settings, None
