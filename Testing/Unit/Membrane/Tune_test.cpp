#include <gtest/gtest.h>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include "Membrane/Simulate.h"
#include "Support/MembraneShapes.h"
using namespace myotet;
using namespace myotet::membrane;
static double env(const char* n, double d) { const char* s = std::getenv(n); return s ? atof(s) : d; }
TEST(Tune, Sphere) {
    const TriMesh s = even_sphere(50, 114);
    std::printf("V %zu F %zu\n", s.points.size(), s.triangles.size());
    std::vector<Result> rs;
    for (auto d : {Detail::coarse, Detail::refined, Detail::adaptive}) {
        Options o; o.detail = d; o.duration = env("DUR", 4);
        o.wall.young = env("E", 0.03); o.wall.shape_stiffness = env("KS", 1e-4);
        o.wall.drag = env("DRAG", 5); o.wall.damping_time = env("TAU", 1e-3);
        o.wall.shape_damping_time = env("STAU", 1e-2);
        o.criteria.rings = env("RINGS", 1); o.criteria.curvature = env("CURV", 0.02); o.criteria.speed = env("SPEED", 50);
        o.criteria.traction = env("TRAC", 1e-5);
        Loads l; PatchForce p; p.centre = Vec3(0,0,50); p.radius = env("R", 25); p.force = Vec3(0,0,-env("F", 1)); p.until = 2; p.ramp = env("RAMP", 0.1);
        l.patches = {p};
        SilentProgress q; 
        clock_t c0 = clock();
        Result r = simulate(s, o, l, q);
        double cpu = double(clock()-c0)/CLOCKS_PER_SEC;
        size_t mn=1e9,mx=0,ms=0; double tot=0; for (auto& m : r.history) { mn = std::min(mn,m.nodes); mx=std::max(mx,m.nodes); ms=std::max(ms,m.springs); tot+=m.nodes; }
        std::printf("cpu %.3f steps %ld eval %ld springeval %ld rej %ld switches %ld sw.energy %g status %d %s nodes %zu..%zu mean %.0f springs max %zu\n", cpu, r.steps, r.evaluations, r.spring_evaluations, r.rejected, r.switches, r.switched_energy, (int)r.status, r.message.c_str(), mn, mx, tot/r.history.size(), ms);
        rs.push_back(r);
    }
    double pk = 0, dc=0, da=0; 
    for (auto& m : rs[1].history) pk = std::max(pk, m.patch_displacement[0]);
    for (size_t i = 0; i < rs[1].history.size(); ++i) {
        double a=rs[0].history[i].patch_displacement[0], b=rs[1].history[i].patch_displacement[0], c=rs[2].history[i].patch_displacement[0];
        dc=std::max(dc,std::abs(a-b)); da=std::max(da,std::abs(c-b));
        if (i % (int)env("EVERY", 40) == 0) std::printf("%.2f  %.4f %.4f %.4f  nodes %zu E %.4g maxd %.3f %.3f\n", rs[1].history[i].time, a,b,c, rs[2].history[i].nodes, rs[2].history[i].energy, rs[1].history[i].largest_displacement, rs[2].history[i].largest_displacement);
    }
    std::printf("peak %.4f coarse %.2f%% adaptive %.2f%% saved evalsprings %.1f%%\n", pk, 100*dc/pk, 100*da/pk, 100-100.0*rs[2].spring_evaluations/rs[1].spring_evaluations);
}
