'use strict';
(() => {
  const root = document.documentElement;
  const number = (of, name) => Number(of.dataset[name]);

  // The turning picture: a slider, keys and dragging, once the style's own turning is off.
  const view = document.getElementById('turn');
  const sheet = view.querySelector('img');
  const slider = document.getElementById('angle');
  const play = document.getElementById('play');
  const frames = number(view, 'frames');
  const columns = number(view, 'columns');
  const places = JSON.parse(view.dataset.marks);
  const step_ms = 150;
  let shown = 0;
  let timer = 0;

  const show = (frame) => {
    shown = ((Math.round(frame) % frames) + frames) % frames;
    sheet.style.left = -100 * (shown % columns) + '%';
    sheet.style.top = -100 * Math.floor(shown / columns) + '%';
    slider.value = String(shown);
    const degrees = Math.round(shown * 360 / frames);
    slider.setAttribute('aria-valuetext', degrees + ' degrees');
    document.getElementById('degrees').textContent = degrees + '°';
    view.querySelectorAll('.mark').forEach((mark, k) => {
      const [x, y, seen] = places[k][shown];
      mark.style.left = x + '%';
      mark.style.top = y + '%';
      mark.hidden = !seen;
    });
  };
  const turn_by_itself = (on) => {
    clearInterval(timer);
    timer = on ? setInterval(() => show(shown + 1), step_ms) : 0;
    play.textContent = on ? 'Stop' : 'Turn';
  };

  root.classList.add('scripted');
  document.getElementById('controls').hidden = false;
  slider.addEventListener('input', () => { turn_by_itself(false); show(slider.value); });
  slider.addEventListener('keydown', (event) => {
    const steps = {ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1}[event.key];
    if (steps) { // past the end too, unlike the slider's own keys
      event.preventDefault();
      turn_by_itself(false);
      show(shown + steps);
    }
  });
  play.addEventListener('click', () => turn_by_itself(timer === 0));
  let drag = null;
  view.addEventListener('pointerdown', (event) => {
    turn_by_itself(false);
    drag = {x: event.clientX, frame: shown};
    view.setPointerCapture(event.pointerId);
  });
  view.addEventListener('pointermove', (event) => {
    if (drag) {
      show(drag.frame + (event.clientX - drag.x) / view.clientWidth * frames);
    }
  });
  for (const end of ['pointerup', 'pointercancel']) {
    view.addEventListener(end, () => { drag = null; });
  }

  // A behaviour plays once on a press: its pictures lie side by side.
  document.querySelectorAll('.behaviour').forEach((behaviour) => {
    const film = behaviour.querySelector('.film');
    const row = film.querySelector('img');
    const press = behaviour.querySelector('button');
    let playing = 0;
    press.hidden = false;
    press.addEventListener('click', () => {
      let picture = 0;
      clearInterval(playing);
      row.style.left = '0';
      playing = setInterval(() => {
        picture += 1;
        row.style.left = -100 * picture + '%';
        if (picture + 1 >= number(film, 'frames')) {
          clearInterval(playing);
        }
      }, number(film, 'step'));
    });
  });

  // A torch: its content is visible around the pointer. All contents use the same plain sheet.
  const plain = document.querySelector('.beam .plain');
  document.querySelectorAll('.beam').forEach((beam) => {
    const copy = (kind) => {
      const made = plain.cloneNode();
      made.alt = '';
      made.className = kind;
      return made;
    };
    if (!beam.contains(plain)) {
      beam.prepend(copy('plain'));
    }
    if (beam.dataset.lens) {
      beam.style.setProperty('--zoom', beam.dataset.lens);
      beam.firstElementChild.after(copy('lit lens'));
    }
    beam.addEventListener('pointermove', (event) => {
      const box = beam.getBoundingClientRect();
      beam.style.setProperty('--x', event.clientX - box.left + 'px');
      beam.style.setProperty('--y', event.clientY - box.top + 'px');
      beam.style.setProperty('--radius', '3.5rem');
    });
    beam.addEventListener('pointerleave', () => beam.style.setProperty('--radius', '0px'));
  });

  // A page that reloads itself continues at the same picture.
  const kept = /^#turn=(\d+)(,stop)?$/.exec(location.hash);
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  show(kept ? Number(kept[1]) : 0);
  turn_by_itself(kept ? !kept[2] : !still);
  root.keep = () => '#turn=' + shown + (timer === 0 ? ',stop' : '');

  // Names the pictures and sounds that this browser cannot show or play, instead of leaving an empty place.
  const images = [...document.images];
  const sounds = [...document.querySelectorAll('audio')];
  const bad = new Set();
  const tell = () => {
    root.dataset.pictures = images.filter((image) => image.naturalWidth > 0).length + ' of ' + images.length;
    root.dataset.sounds = sounds.filter((sound) => sound.duration > 0).length + ' of ' + sounds.length;
    document.getElementById('trouble').hidden = bad.size === 0;
  };
  document.addEventListener('securitypolicyviolation', (event) => {
    root.dataset.blocked = event.blockedURI;
  });
  for (const each of [...images, ...sounds]) {
    each.addEventListener('error', () => { bad.add(each); tell(); });
  }
  sounds.forEach((sound) => sound.addEventListener('loadedmetadata', tell));
  Promise.allSettled(images.map((image) => image.decode())).then((results) => {
    results.forEach((result, k) => { if (result.status === 'rejected') { bad.add(images[k]); } });
    tell();
  });
})();
