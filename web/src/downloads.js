// Files for the reader: made in the browser, sent nowhere.

/** Offers a text or a blob as a file of this name. */
export function save(content, name, type) {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Pixels for each drawing unit, and the most in all. */
const SHARPNESS = 2;
const MOST = 16e6;

/** A picture of vectors as one of pixels. */
export async function pixels(svg) {
  const image = new Image();
  const address = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  try {
    image.src = address;
    await image.decode();
    const sharpness = Math.min(SHARPNESS, Math.sqrt(MOST / (image.width * image.height)));
    const canvas = document.createElement("canvas");
    canvas.width = Math.round(sharpness * image.width);
    canvas.height = Math.round(sharpness * image.height);
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  } finally {
    URL.revokeObjectURL(address);
  }
}
