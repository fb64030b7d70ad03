// Numbers as they are typed and shown.

/** A number with at most six significant digits, without needless zeros. */
export function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e7)
    return value
      .toExponential(4)
      .replace(/\.?0+e/, "e")
      .replace("e+", "e");
  return String(Number(value.toPrecision(6)));
}

/** A value with its unit, as the engine reads it. */
export const withUnit = (value, unit) => (unit ? `${short(value)} ${unit}` : short(value));

/** A round number of about this size: 1, 2 or 5 times a power of ten. */
export function round(size) {
  const power = 10 ** Math.floor(Math.log10(size));
  return power * ([5, 2, 1].find((part) => part * power <= size * (1 + 1e-9)) ?? 1);
}

/** Places of round numbers between two ends. */
export function ticks(from, to, count) {
  const step = round((to - from) / count);
  const first = Math.ceil(from / step - 1e-9);
  const last = Math.floor(to / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, index) =>
    Number(((first + index) * step).toPrecision(12)),
  );
}

/** Ends and step of a slider between about these ends. */
export function scale(from, to) {
  const step = round((to - from) / 200);
  const tidy = (value) => Number(value.toPrecision(12));
  return {
    from: tidy(Math.floor(from / step + 1e-9) * step),
    to: tidy(Math.ceil(to / step - 1e-9) * step),
    step: tidy(step),
  };
}
