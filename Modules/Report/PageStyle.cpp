// SPDX-License-Identifier: Apache-2.0
#include "Report/PageStyle.h"

namespace myotet::report {

const std::string_view kPageStyle = R"css(
:root{color-scheme:light dark;--paper:#fff;--card:#f6f7f9;--ink:#1b1f24;--soft:#57606a;
--edge:#d8dee4;--link:#0b5cad;--good:#19703a;--bad:#b3261e;--badly:#fdecea;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#cc79a7;--c4:#c98a00;--c5:#3a9fd6;--c6:#1b1f24;--c7:#a89b00}
@media (prefers-color-scheme:dark){:root{--paper:#14171b;--card:#1d2126;--ink:#e6e9ed;--soft:#9aa5b1;
--edge:#343b43;--link:#7cbcff;--good:#66d193;--bad:#ff9a8f;--badly:#3a1f1d;
--c0:#4aa8e8;--c1:#ff8a3d;--c2:#2fd1a0;--c3:#e9a3c9;--c4:#f0b93a;--c5:#8fd3ff;--c6:#e6e9ed;--c7:#f0e442}}
*{box-sizing:border-box}
body{margin:0 auto;padding:0 1.25rem 3rem;max-width:76rem;background:var(--paper);color:var(--ink);
font:1rem/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",sans-serif}
header{padding:2.2rem 0 .4rem}
h1{font-size:1.9rem;line-height:1.2;margin:0 0 .6rem;overflow-wrap:anywhere}
h2{font-size:1.3rem;margin:2.6rem 0 .8rem;padding-top:.9rem;border-top:1px solid var(--edge)}
h3{font-size:1.05rem;margin:1.6rem 0 .5rem}
p,li{max-width:46rem;overflow-wrap:anywhere}
ul{padding-left:1.2rem}
a{color:var(--link)}
:focus-visible{outline:3px solid var(--link);outline-offset:2px;border-radius:4px}
nav{position:sticky;top:0;z-index:2;background:var(--paper);border-bottom:1px solid var(--edge)}
nav ul{display:flex;gap:1.1rem;list-style:none;margin:0;padding:.55rem 0;overflow-x:auto;white-space:nowrap}
nav a{text-decoration:none}
nav a:hover{text-decoration:underline}
section{scroll-margin-top:3rem}
section:first-of-type h2{border-top:0;margin-top:1rem}
.verdict{display:inline-block;margin:0 0 .6rem;padding:.45rem .9rem;border-radius:.6rem;
border-left:5px solid var(--good);background:var(--card)}
.verdict.bad{border-color:var(--bad);background:var(--badly)}
.facts{display:flex;flex-wrap:wrap;gap:.8rem;margin:.8rem 0 0;padding:0}
.facts div{flex:1 1 9rem;padding:.7rem .9rem;border-radius:.6rem;background:var(--card)}
.facts dt{color:var(--soft);font-size:.85rem}
.facts dd{margin:0;font-size:1.25rem;font-weight:600;font-variant-numeric:tabular-nums}
figure{margin:0}
figcaption{overflow-wrap:anywhere;color:var(--soft);font-size:.9rem;padding:.4rem .1rem 0}
figure img{display:block;max-width:100%;height:auto;margin:0 auto}
.grid img{max-height:28rem;width:auto}
.grid{display:grid;gap:1rem;grid-template-columns:repeat(auto-fill,minmax(min(100%,var(--least,20rem)),1fr))}
.grid figure,.frame{background:#fff;color:#1b1f24;border:1px solid var(--edge);border-radius:.6rem;padding:.6rem}
.grid figure{display:flex;flex-direction:column;justify-content:space-between}
.grid figcaption,.frame figcaption{color:#57606a}
.tissues{--least:11rem}
.swatch{display:inline-block;width:.8em;height:.8em;border-radius:.2em;margin-right:.45em;vertical-align:-.05em}
.charts{display:grid;gap:1.4rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,26rem),1fr))}
.chart{background:var(--card);border-radius:.6rem;padding:.8rem}
.chart figcaption{font-weight:600;color:var(--ink);font-size:1rem;padding:0 0 .2rem}
.chart svg{display:block;width:100%;height:auto}
.chart text{fill:var(--soft);font-size:13px;font-family:inherit}
.rules{fill:none;stroke:var(--edge);stroke-width:1}
.line{fill:none;stroke:var(--c);stroke-width:2.2;stroke-linejoin:round;stroke-linecap:round}
.line.again{stroke-dasharray:7 5}
.bar{fill:var(--c0)}
.legend{display:flex;flex-wrap:wrap;gap:.1rem 1rem;list-style:none;margin:0 0 .3rem;padding:0;font-size:.88rem}
.key{display:inline-block;width:1.5em;border-top:3px solid var(--c);margin-right:.4em;vertical-align:.25em}
.key.again{border-top-style:dashed}
.line-0{--c:var(--c0)}.line-1{--c:var(--c1)}.line-2{--c:var(--c2)}.line-3{--c:var(--c3)}
.line-4{--c:var(--c4)}.line-5{--c:var(--c5)}.line-6{--c:var(--c6)}.line-7{--c:var(--c7)}
.scroll{overflow-x:auto;margin:.6rem 0 1rem}
table{border-collapse:collapse;font-size:.92rem;font-variant-numeric:tabular-nums}
caption{text-align:left;color:var(--soft);padding:.2rem 0 .4rem}
th,td{padding:.32rem .75rem;border-bottom:1px solid var(--edge);text-align:left;vertical-align:top}
thead th{vertical-align:bottom;color:var(--soft);font-weight:600}
tbody th{font-weight:500;min-width:13rem;max-width:26rem;overflow-wrap:break-word}
tbody tr:hover{background:var(--card)}
th.number,td.number{text-align:right}
td.number{white-space:nowrap}
.kept{color:var(--good);white-space:nowrap}
.broken{color:var(--bad);white-space:nowrap}
.strip{margin:.6rem 0 1.4rem;max-width:62rem}
.frames{display:flex;gap:1rem;overflow-x:auto;padding-bottom:.4rem;scroll-snap-type:x proximity}
.frame{flex:0 0 auto;width:min(100%,34rem);scroll-snap-align:start}
.frame svg{display:block;width:100%;max-height:min(70vh,38rem)}
.frame img{display:block;max-width:100%;height:auto;margin:0 auto}
.slice image{image-rendering:pixelated}
.outline path{fill:none;stroke-width:1.6;vector-effect:non-scaling-stroke;stroke-linejoin:round}
.sides{fill:#333;stroke:#fff;paint-order:stroke;font-weight:700}
.controls{display:flex;align-items:center;gap:.8rem;margin:.2rem 0 .6rem;flex-wrap:wrap}
.controls input{flex:1 1 12rem;accent-color:var(--link)}
.controls output{min-width:8rem;font-variant-numeric:tabular-nums}
button{font:inherit;padding:.25rem .9rem;border:1px solid var(--edge);border-radius:.5rem;background:var(--card);
color:var(--ink);cursor:pointer}
.slides figcaption{display:none}
.slides .frames{display:block;overflow:visible}
.slides .frame{width:100%}
.slides .frame:not(.shown){display:none}
.planes{display:grid;gap:1.2rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,21rem),1fr));align-items:start}
.planes .strip{min-width:0}
.licences pre{white-space:pre-wrap;font-size:.8rem}
footer{margin-top:3rem;padding-top:.8rem;border-top:1px solid var(--edge);color:var(--soft);font-size:.9rem}
@media (max-width:40rem){body{padding:0 .8rem 2rem}h1{font-size:1.5rem}header{padding-top:1.2rem}
.tissues{--least:8.5rem}.grid{gap:.6rem}}
@media print{:root{--paper:#fff;--card:#fff;--ink:#000;--soft:#444;--edge:#bbb;--link:#000;--good:#000;--bad:#000;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#cc79a7;--c4:#c98a00;--c5:#3a9fd6;--c6:#000;--c7:#a89b00}
body{max-width:none;padding:0;font-size:10pt}nav,.controls,.viewer,.licences,.for-screens{display:none}.scroll{overflow:visible}
table{font-size:8pt}th,td{padding:.15rem .35rem}
.grid{grid-template-columns:repeat(3,1fr)}.tissues{grid-template-columns:repeat(5,1fr)}.charts{grid-template-columns:1fr 1fr}
.planes,.frames,.slides .frames{display:grid;grid-template-columns:repeat(3,1fr);overflow:visible}
.planes .frames,.planes .slides .frames{grid-template-columns:1fr}
.frame,.slides .frame,.slides .frame:not(.shown){display:block;width:auto}
.planes .frame:not(.shown),.planes .slides .frame:not(.shown){display:none}
.slides figcaption{display:block}figure,.frame,tr{break-inside:avoid}h2,h3{break-after:avoid}}
)css";

const std::string_view kPageScript = R"js(
(function () {
  "use strict";
  function enhance(strip) {
    var frames = Array.prototype.slice.call(strip.querySelectorAll(".frame"));
    if (frames.length === 1 || !frames.length) return;
    var controls = document.createElement("div");
    var slider = document.createElement("input");
    var said = document.createElement("output");
    var timer = null, at = frames.findIndex(function (f) { return f.classList.contains("shown"); });
    controls.className = "controls";
    slider.type = "range";
    slider.min = 0;
    slider.max = frames.length - 1;
    slider.setAttribute("aria-label", strip.getAttribute("aria-label"));
    function show(i) {
      frames[at].classList.remove("shown");
      at = i;
      frames[at].classList.add("shown");
      slider.value = at;
      var name = frames[at].querySelector("figcaption").textContent;
      said.textContent = name;
      slider.setAttribute("aria-valuetext", name);
    }
    slider.addEventListener("input", function () { stop(); show(Number(slider.value)); });
    var button = document.createElement("button");
    function stop() { clearInterval(timer); timer = null; button.textContent = "Play"; }
    if (strip.hasAttribute("data-plays")) {
      button.type = "button";
      button.textContent = "Play";
      button.addEventListener("click", function () {
        if (timer !== null) return stop();
        button.textContent = "Pause";
        timer = setInterval(function () { show((at + 1) % frames.length); }, 250);
      });
      controls.appendChild(button);
    }
    controls.appendChild(slider);
    controls.appendChild(said);
    strip.querySelector(".frames").removeAttribute("tabindex");
    strip.insertBefore(controls, strip.firstChild);
    strip.classList.add("slides");
    show(at);
  }
  Array.prototype.forEach.call(document.querySelectorAll(".strip"), enhance);
})();
)js";

}  // namespace myotet::report
