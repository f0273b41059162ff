#pragma once

namespace svnet::report {

/// The style of all pages. Colours are named in one place, for light and for dark; text has a contrast of 4.5 or more.
inline constexpr const char* kPageStyle = R"(
:root{color-scheme:light dark;--paper:#fff;--panel:#f5f6f8;--ink:#1b1f24;--soft:#555e6a;--line:#dde1e6;--other:#6b7480;
--accent:#0b62c0;--good:#12813f;--bad:#c3261f;--warn:#fff4d6;
--c0:#0b62c0;--c1:#b8480a;--c2:#0a7455;--c3:#a83a80;--c4:#8a6100;--c5:#5a45b8;--c6:#b3261e;--c7:#5d6672}
@media (prefers-color-scheme:dark){:root{--paper:#14171a;--panel:#1d2126;--ink:#e9ebee;--soft:#a8b0bb;--line:#343a42;
--other:#98a1ad;--accent:#6cb2f7;--good:#4fd08b;--bad:#ff8078;--warn:#40340f;
--c0:#6cb2f7;--c1:#f2935c;--c2:#4cc9a0;--c3:#e58fc4;--c4:#e3b341;--c5:#a79bf5;--c6:#ff8078;--c7:#b0b8c3}}
*{box-sizing:border-box}
html{scroll-behavior:smooth;scroll-padding-top:1rem;-webkit-text-size-adjust:100%}
@media (prefers-reduced-motion:reduce){html{scroll-behavior:auto}}
body{margin:0;background:var(--paper);color:var(--ink);
font:1rem/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif;
font-variant-numeric:tabular-nums;overflow-wrap:anywhere}
header,main,footer,nav>ul{max-width:72rem;margin:0 auto;padding:0 1rem}
header{padding-top:2.5rem}
h1{font-size:1.9rem;line-height:1.2;margin:0 0 1rem;letter-spacing:-.015em}
h2{font-size:1.35rem;line-height:1.25;margin:0 0 .5rem;letter-spacing:-.01em}
h3{font-size:1rem;margin:0 0 .5rem}
p{max-width:44rem;margin:0 0 1rem}
.summary{font-size:1.125rem}
.how,.caption,figcaption,footer{color:var(--soft)}
.caption,figcaption{font-size:.875rem;line-height:1.45}
.warning{background:var(--warn);border-left:4px solid var(--c4);padding:.75rem 1rem}
a{color:var(--accent);text-underline-offset:.15em}
a:focus-visible,summary:focus-visible,[tabindex]:focus-visible{outline:3px solid var(--accent);outline-offset:2px}
nav{border-block:1px solid var(--line);margin-top:1.5rem}
nav>ul{list-style:none;display:flex;flex-wrap:wrap;gap:.25rem 1.25rem;padding-block:.75rem}
section{margin:3.5rem 0}
footer{border-top:1px solid var(--line);padding-block:1.5rem 3rem;font-size:.875rem}
dl.facts{display:grid;grid-template-columns:minmax(8rem,max-content) 1fr;gap:.25rem 1.25rem;margin:0 0 1rem;
max-width:60rem;font-size:.9375rem}
dl.facts dt{color:var(--soft)}dl.facts dd{margin:0}
.scroll{overflow-x:auto;margin:0 0 1.5rem}
table{border-collapse:collapse;font-size:.9375rem;overflow-wrap:normal}
caption{text-align:left;color:var(--soft);font-size:.875rem;padding-bottom:.5rem}
th,td{padding:.3rem .75rem .3rem 0;text-align:right;vertical-align:top;font-weight:400}
thead th{color:var(--soft);border-bottom:1px solid var(--line);vertical-align:bottom}
th:first-child,td.word,th.word{text-align:left}
tbody tr+tr>*{border-top:1px solid var(--line)}
tr.group th{font-weight:600;padding-top:1rem}
tr.svnet>*{font-weight:600;color:var(--accent)}
td{white-space:nowrap}td.word{white-space:normal}td.left{text-align:left}
td small{display:block;color:var(--soft);font-weight:400;white-space:nowrap;font-size:.75rem}
.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,20.5rem),1fr));gap:1.5rem 2rem;margin:0 0 1.5rem}
figure{margin:0}
svg{display:block;max-width:100%;height:auto}
svg text{fill:var(--ink);font-size:12px}
svg .title{font-size:13px;font-weight:600}svg .tick{fill:var(--soft);font-size:11px}
svg .strong{font-weight:600}
.grid{stroke:var(--line)}.zero{stroke:var(--soft);stroke-width:1.5}
.bar{stroke-width:2;opacity:.75}.bar.accent{stroke:var(--accent)}.bar.other{stroke:var(--other)}
.dot{stroke-width:2}.dot.accent{fill:var(--accent);stroke:var(--accent)}.dot.other{fill:var(--other);stroke:var(--other)}
.dot.hollow{fill:var(--paper)}
.whisker{stroke:var(--other)}.box{fill:var(--line);stroke:var(--other)}.median{stroke:var(--ink);stroke-width:2}
.curve{fill:none;stroke-width:2;stroke-linejoin:round}
.frame{fill:none;stroke:var(--line)}.point{opacity:.85}
.fill-c0{fill:var(--c0)}.fill-c1{fill:var(--c1)}.fill-c2{fill:var(--c2)}.fill-c3{fill:var(--c3)}
.fill-c4{fill:var(--c4)}.fill-c5{fill:var(--c5)}.fill-c6{fill:var(--c6)}.fill-c7{fill:var(--c7)}
svg text.fill-c0{fill:var(--c0)}svg text.fill-c1{fill:var(--c1)}svg text.fill-c2{fill:var(--c2)}
svg text.fill-c3{fill:var(--c3)}svg text.fill-c4{fill:var(--c4)}svg text.fill-c5{fill:var(--c5)}
svg text.fill-c6{fill:var(--c6)}svg text.fill-c7{fill:var(--c7)}
.stroke-c0{stroke:var(--c0)}.stroke-c1{stroke:var(--c1)}.stroke-c2{stroke:var(--c2)}.stroke-c3{stroke:var(--c3)}
.stroke-c4{stroke:var(--c4)}.stroke-c5{stroke:var(--c5)}.stroke-c6{stroke:var(--c6)}.stroke-c7{stroke:var(--c7)}
.legend{list-style:none;display:flex;flex-wrap:wrap;gap:.25rem 1rem;padding:0;margin:0 0 1rem;font-size:.875rem}
.legend li{display:flex;align-items:center;gap:.4rem}.legend svg{flex:none}
.mark{fill:none;stroke-linejoin:round}.halo{stroke:#fff;stroke-width:5.5}
.best{stroke:#12813f;stroke-width:3}.worst{stroke:#c3261f;stroke-width:3;stroke-dasharray:5 3}
.chosen{fill:#fff;stroke:#111;stroke-width:2.5}.unknown{fill:var(--panel);stroke:var(--line)}
.object-axis{stroke:#111;stroke-width:1.5;stroke-dasharray:2 3}
svg text.ring{font-size:10px;paint-order:stroke;stroke:var(--paper);stroke-width:3px}
.poses{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,33rem),1fr));gap:1.5rem}
.pose{background:var(--panel);border-radius:.5rem;padding:1rem}
.pose svg text.ring{stroke:var(--panel)}
.shots{display:grid;grid-template-columns:repeat(3,minmax(0,1fr));gap:.75rem;margin:0 0 .75rem}
.shot{position:relative}.shot img{display:block;width:100%;height:auto;border-radius:.25rem}
.shot .overlay{position:absolute;inset:0;width:100%;height:100%}
.axis-halo{stroke:#fff;stroke-width:4}.axis-line{stroke:#111;stroke-width:1.75}.axis-head{fill:#111;stroke:#fff;stroke-width:1}
.maps{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:.75rem;margin:0 0 .5rem}
.maps svg{width:100%}
.pose .caption{margin:0}
details{border-top:1px solid var(--line)}details:last-of-type{border-bottom:1px solid var(--line)}
summary{cursor:pointer;padding:.6rem 0}summary strong{font-weight:600}
td img{display:block;width:72px;height:auto;border-radius:.2rem}
:target{outline:3px solid var(--accent);outline-offset:4px}
@media (max-width:30rem){h1{font-size:1.55rem}section{margin:2.5rem 0}.summary{font-size:1.0625rem}
dl.facts{grid-template-columns:1fr;gap:0}dl.facts dd{margin:0 0 .5rem}
.maps{gap:0}.maps svg text{font-size:15px}.maps svg .title{font-size:17px}.maps svg text.ring{font-size:13px}
.pose{padding:.75rem}td img{width:56px}th,td{padding-right:.6rem}}
@media print{nav{display:none}section{break-inside:avoid}}
)";

}  // namespace svnet::report
