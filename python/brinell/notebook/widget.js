// The studio as a widget of a notebook: its page in a frame, its messages to the kernel and back. The kernel holds an engine for each view.

/** How many views this page has shown. */
let views = 0;

/** @param {{model: any, el: HTMLElement}} context */
function render({ model, el }) {
  const frame = document.createElement("iframe");
  frame.title = "brinell studio";
  frame.className = "brinell-studio";
  // An origin of its own: the page reaches neither the notebook nor its storage.
  frame.sandbox = "allow-scripts allow-downloads";
  frame.allow = "autoplay; clipboard-write";
  let view = "", port = null, seen = true, held = [];

  const send = (content, bytes) => model.send({ ...content, view }, undefined, bytes ? [bytes] : []);
  const leave = () => {
    if (port) {
      port.close();
      send({ do: "close" });
    }
    port = null;
    held = [];
  };
  const ask = ({ id, bytes }) => send({ do: "ask", id }, bytes);

  // A frame that was moved in the document starts anew, and its bearing with it.
  frame.addEventListener("load", () => {
    if (!frame.srcdoc) return;
    leave();
    view = `${++views}-${Math.random().toString(36).slice(2)}`;
    const channel = new MessageChannel();
    port = channel.port1;
    port.onmessage = ({ data }) => { if (seen) ask(data); else held.push(data); };
    frame.contentWindow.postMessage({ brinell: true, scenario: model.get("scenario") }, "*", [channel.port2]);
  });

  // A page that nobody sees leaves the kernel alone.
  const watch = new IntersectionObserver((entries) => {
    seen = entries[entries.length - 1].isIntersecting;
    if (seen) for (const request of held.splice(0)) ask(request);
  });

  const hear = (content, buffers) => {
    if (content.page === "here" && !frame.srcdoc) frame.srcdoc = new TextDecoder().decode(buffers[0]);
    if (!port) return;
    if (content.load !== undefined) port.postMessage({ load: content.load });
    if (content.view !== view) return;
    if (content.lost !== undefined) port.postMessage({ lost: content.lost });
    if (content.id === undefined) return;
    const { buffer, byteOffset, byteLength } = buffers[0], bytes = new Uint8Array(buffer, byteOffset, byteLength).slice();
    port.postMessage({ id: content.id, bytes }, [bytes.buffer]);
  };

  model.on("msg:custom", hear);
  el.append(frame);
  watch.observe(frame);
  send({ do: "page" });
  return () => {
    model.off("msg:custom", hear);
    watch.disconnect();
    leave();
    frame.remove();
  };
}

export default { render };
