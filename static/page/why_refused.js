// Why the page cannot connect: the server knows, and is asked at once, when the client's first tries are through, and
// from time to time, since it may come back with another token.
(() => {
  const bar = document.createElement("div");
  bar.setAttribute("role", "alert");
  bar.setAttribute("aria-label", "Why this page cannot connect");
  bar.style.cssText = "position:fixed;inset:0 0 auto 0;z-index:100000;padding:12px 16px;font:15px/1.45 system-ui," +
    "sans-serif;background:#fff4e6;color:#1a1b1e;border-bottom:3px solid #d55e00;overflow-wrap:anywhere";
  const waits = [3, 7];
  const ask = async () => {
    try {
      const answer = await fetch("why-refused?origin=" + encodeURIComponent(location.origin), {cache: "no-store"});
      const kind = answer.headers.get("Content-Type") || "";
      const text = answer.ok && kind.startsWith("text/plain") ? (await answer.text()).trim() : "";
      bar.textContent = text;
      if (text) document.body.append(bar); else bar.remove();
    } catch { /* the server is gone: viser's client says that itself */ }
    setTimeout(ask, 1000 * (waits.shift() || 30));
  };
  if (document.body) ask(); else document.addEventListener("DOMContentLoaded", ask);
})();
