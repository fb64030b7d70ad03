// Live figures, where the page is beside the book (`node web/tools/build.js --into docs/book/page`). Elsewhere, and where
// scripts are off, the pictures within <slideway-live> stay as they are.
if (document.querySelector("slideway-live")) {
  const script = document.createElement("script");
  script.type = "module";
  script.src = `${typeof path_to_root === "string" ? path_to_root : ""}page/embed.js`;
  document.head.append(script);
}
